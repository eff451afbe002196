#!/usr/bin/env python3
"""Another program's bag, by ROS's own writer: the cloud of BAG as /points, and poses beside it.
write_bag.py BAG NEW_BAG"""
import sys

import genpy
import rosbag

with rosbag.Bag(sys.argv[1]) as source, rosbag.Bag(sys.argv[2], "w") as bag:
    for topic, message, time in source.read_messages():
        if message._type == "sensor_msgs/PointCloud2":
            bag.write("/points", message, time)
            begin = time
        elif message._type == "geometry_msgs/PoseStamped":
            pose = message
    for number, x in enumerate([0.1, 1 / 3, float("nan")]):
        pose.header.frame_id = "map"
        pose.header.stamp = begin + genpy.Duration(number)
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, -2.0, 1e-9
        rotation = pose.pose.orientation
        rotation.w, rotation.x, rotation.y, rotation.z = 0.8, 0.0, 0.6, 0.0
        bag.write("/goal", pose, pose.header.stamp)
