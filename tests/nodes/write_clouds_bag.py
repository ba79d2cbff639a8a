# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""write_clouds_bag.py FILE.bag COUNT: a bag with messages of COUNT points of a Livox on /livox/lidar, serialized by ROS's
own classes for the published definition."""
import sys

import genpy.dynamic
import rosbag
import rospy

definition = """std_msgs/Header header
uint64 timebase
uint32 point_num
uint8 lidar_id
uint8[3] rsvd
CustomPoint[] points
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
================================================================================
MSG: livox_ros_driver/CustomPoint
uint32 offset_time
float32 x
float32 y
float32 z
uint8 reflectivity
uint8 tag
uint8 line
"""
classes = genpy.dynamic.generate_dynamic("livox_ros_driver/CustomMsg", definition)
Message, Point = classes["livox_ros_driver/CustomMsg"], classes["livox_ros_driver/CustomPoint"]
count = int(sys.argv[2])
with rosbag.Bag(sys.argv[1], "w") as bag:
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
