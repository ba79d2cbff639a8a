# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""write_clouds_bag.py FILE.bag COUNT: a bag with messages of COUNT points of a Livox on /livox/lidar.
write_clouds_bag.py FILE.bag COUNT DATA: a bag with a cloud of COUNT points that Draco has compressed to the file DATA, on
/points/draco. ROS's own classes for the published definitions serialize them."""
import sys

import genpy.dynamic
import rosbag
import rospy

header = """================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
"""
livox = """std_msgs/Header header
uint64 timebase
uint32 point_num
uint8 lidar_id
uint8[3] rsvd
CustomPoint[] points
""" + header + """================================================================================
MSG: livox_ros_driver/CustomPoint
uint32 offset_time
float32 x
float32 y
float32 z
uint8 reflectivity
uint8 tag
uint8 line
"""
draco = """std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] compressed_data
bool is_dense
""" + header + """================================================================================
MSG: sensor_msgs/PointField
string name
uint32 offset
uint8 datatype
uint32 count
"""


def write_livox(bag, count):
    classes = genpy.dynamic.generate_dynamic("livox_ros_driver/CustomMsg", livox)
    Message, Point = classes["livox_ros_driver/CustomMsg"], classes["livox_ros_driver/CustomPoint"]
    for k in range(3):
        message = Message()
        message.header.frame_id = "livox_frame"
        message.header.stamp = rospy.Time(5 + k, 6)
        message.timebase = (5 + k) * 10**9 + 6
        message.point_num = count
        message.rsvd = [0, 0, 0]
        message.points = [Point(1000 * i + 7, i + 0.1, -float(i), 0.5, 255 - i % 256, 16 + i % 3, i % 4)
                          for i in range(count)]
        bag.write("/livox/lidar", message, rospy.Time(100 + k))


def write_draco(bag, count, data):
    classes = genpy.dynamic.generate_dynamic("draco_point_cloud_transport/CompressedPointCloud2", draco)
    message, Field = classes["draco_point_cloud_transport/CompressedPointCloud2"](), classes["sensor_msgs/PointField"]
    message.header.frame_id = "lidar"
    message.header.stamp = rospy.Time(5, 6)
    message.height, message.width, message.point_step, message.row_step = 1, count, 24, 24 * count
    message.fields = [Field("x", 0, 7, 1), Field("y", 4, 7, 1), Field("z", 8, 7, 1), Field("id", 12, 6, 1),
                      Field("ring", 16, 4, 1), Field("rgb", 20, 7, 1)]
    message.compressed_data = data
    message.is_dense = True
    bag.write("/points/draco", message, rospy.Time(100))


with rosbag.Bag(sys.argv[1], "w") as bag:
    if len(sys.argv) == 3:
        write_livox(bag, int(sys.argv[2]))
    else:
        with open(sys.argv[3], "rb") as data:
            write_draco(bag, int(sys.argv[2]), data.read())
