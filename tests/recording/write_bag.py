# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""write_bag.py FILE.bag COMPRESSION: a bag of ROS's own writer, and its messages as JSON on standard output."""
import json
import random
import sys

import rosbag
import rospy
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

random.seed(5)
sent = []
with rosbag.Bag(sys.argv[1], "w", compression=sys.argv[2], chunk_threshold=4096) as bag:
    for i in range(120):
        stamp = rospy.Time(100 + i // 10, 1000 * i)
        time = rospy.Time(100 + i // 10 + random.randrange(2), random.randrange(10**9))
        if i % 3 == 0:
            topic, message = "/status", Header(stamp=stamp, frame_id="frame %d" % i)
        else:
            width = random.randrange(40)
            fields = [PointField(n, 4 * k, PointField.FLOAT32, 1) for k, n in enumerate("xyz")]
            topic = "/points"
            message = PointCloud2(Header(i, stamp, "velodyne"), 1, width, fields, False, 12, 12 * width,
                                  bytes(random.randrange(60) for _ in range(12 * width)), True)
        bag.write(topic, message, time)
for topic, message, time in rosbag.Bag(sys.argv[1]).read_messages(raw=True):
    sent.append([topic, time.to_nsec(), message[0], message[1].hex()])
json.dump(sorted(sent, key=lambda message: message[1]), sys.stdout)  # its own order is not by time within a second
