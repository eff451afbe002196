"""Copies a bag and packs its chunks: pack_bag.py FROM TO none|bz2|lz4, with ROS's own library."""

import sys

import rosbag

with rosbag.Bag(sys.argv[1]) as source, rosbag.Bag(sys.argv[2], "w", compression=sys.argv[3]) as target:
    for topic, message, time in source.read_messages(raw=True):
        target.write(topic, message, time, raw=True)
