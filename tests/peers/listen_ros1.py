# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""listen_ros1.py FILE: publishes clouds of two boxes to ROS 1's node and hears the topics of its parameter `publish`.

genmsg computes the sum of each type from the definition that the node sends, and genpy decodes the messages by it.
Sums, bytes and numbers must be equal. FILE gets the definitions and messages, for check_ros1.mjs.
"""
import io
import json
import sys
import threading

import genpy.dynamic
import numpy
import rospy
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

# As published for Noetic.
SUMS = {
    "planning_scene": ("moveit_msgs/PlanningScene", "acfc50bcfd6c7b978066bfa7c786002c"),
    "collision_object": ("moveit_msgs/CollisionObject", "dbba710596087da521c07564160dfccb"),
    "footprints": ("geometry_msgs/PolygonStamped", "c6be8f7dc3bee7fe9e8d296070f53340"),
    "objects": ("vision_msgs/Detection3DArray", "05c51d9aea1fb4cfdc8effb94f197b6f"),
    "boxes": ("vision_msgs/BoundingBox3DArray", "9e1a3932308592aa1b20232d818486db"),
}

random = numpy.random.default_rng(20261127)
# The larger cluster first, as in results.
objects = [random.uniform(-0.5, 0.5, (600, 3)) + [6, 1, 0], random.uniform(-0.5, 0.5, (400, 3)) + [9, -3, 0.5]]
objects = [points.astype(numpy.float32) for points in objects]
bounds = [(points.min(0).astype(float), points.max(0).astype(float)) for points in objects]

lock = threading.Lock()
heard = {topic: [] for topic in SUMS}


def hear(topic):
    def keep(message):
        with lock:
            heard[topic].append(message)

    rospy.Subscriber(topic, rospy.AnyMsg, keep, queue_size=1000)


def cloud():
    points = numpy.concatenate(objects)
    fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
    return PointCloud2(Header(stamp=rospy.Time(17, 5), frame_id="arm"), 1, len(points), fields, False, 12,
                       12 * len(points), points.tobytes(), True)


def decoded(topic, messages):
    name, sum_ = SUMS[topic]
    decoded_messages = []
    for message in messages:
        header = message._connection_header
        assert header["type"] == name and header["md5sum"] == sum_, header
        kind = genpy.dynamic.generate_dynamic(name, header["message_definition"])[name]
        assert kind._md5sum == sum_, f"{name}: the definition has the sum {kind._md5sum}"
        again = io.BytesIO()
        one = kind().deserialize(message._buff)
        one.serialize(again)
        assert again.getvalue() == message._buff, name
        decoded_messages.append(one)
    return decoded_messages


def xyz(vector):
    return numpy.array([vector.x, vector.y, vector.z])


def check_box(centre, size, box):
    low, high = bounds[box]
    assert numpy.abs(xyz(centre) - (low + high) / 2).max() < 1e-12, (centre, low, high)
    assert (numpy.array(size) == high - low).all(), (size, low, high)


def check(messages):
    for scene in messages["planning_scene"]:
        assert scene.is_diff and scene.robot_state.is_diff
        assert [o.id for o in scene.world.collision_objects] == ["bv_cluster_0", "bv_cluster_1"]
        for i, found in enumerate(scene.world.collision_objects):
            assert found.header.frame_id == "arm" and found.header.stamp == rospy.Time(17, 5)
            assert found.primitives[0].type == found.primitives[0].BOX and found.operation == found.ADD
            check_box(found.pose.position, found.primitives[0].dimensions, i)
    for found in messages["collision_object"]:
        check_box(found.pose.position, found.primitives[0].dimensions, int(found.id[-1]))
    for footprint in messages["footprints"]:
        corners = {(p.x, p.y) for p in footprint.polygon.points}
        expected = [{(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])} for low, high in bounds]
        assert any(len(corners) == 4 and all(min(abs(x - a) + abs(y - b) for a, b in e) < 1e-6 for x, y in corners)
                   for e in expected), corners
    for array in messages["boxes"]:
        for i, box in enumerate(array.boxes):
            check_box(box.center.position, xyz(box.size), i)
    for array in messages["objects"]:
        assert len(array.detections) == 2
        for i, detection in enumerate(array.detections):
            check_box(detection.bbox.center.position, xyz(detection.bbox.size), i)
            rows = numpy.frombuffer(detection.source_cloud.data, numpy.float32).reshape(-1, 4)[:, :3]
            assert sorted(map(tuple, rows)) == sorted(map(tuple, objects[i]))


def main():
    rospy.init_node("listener")
    for topic in SUMS:
        hear(topic)
    publisher = rospy.Publisher("points", PointCloud2, queue_size=1)
    for _ in range(600):
        publisher.publish(cloud())
        rospy.sleep(0.1)
        with lock:
            if all(len(messages) >= 10 for messages in heard.values()):
                break
    with lock:
        taken = {topic: messages[:10] for topic, messages in heard.items()}
    assert all(taken.values()), {topic: len(messages) for topic, messages in taken.items()}
    check({topic: decoded(topic, messages) for topic, messages in taken.items()})
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        json.dump([{"definition": m._connection_header["message_definition"], "topic": t, "data": m._buff.hex()}
                   for t, messages in taken.items() for m in messages], file)
    print("genpy: " + ", ".join(f"{len(messages)} of {SUMS[t][0]}" for t, messages in taken.items()) + " equal")


main()
