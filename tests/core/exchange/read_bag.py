#!/usr/bin/env python3
"""What ROS's own reader finds in a bag, as a JSON list: one entry a message, in the order of their times."""
import json
import struct
import sys

import rosbag

SIZES = {5: ("<i", 4), 7: ("<f", 4), 8: ("<d", 8)}  # sensor_msgs/PointField: INT32, FLOAT32, FLOAT64


def pose(position, rotation):
    return {"position": [position.x, position.y, position.z],
            "rotation_wxyz": [rotation.w, rotation.x, rotation.y, rotation.z]}


def point(cloud, index):
    values = {}
    for field in cloud.fields:
        layout, size = SIZES[field.datatype]
        at = index * cloud.point_step + field.offset
        values[field.name] = struct.unpack(layout, bytes(cloud.data[at:at + size]))[0]
    return {name: value if value == value else None for name, value in values.items()}


def describe(topic, message, time):
    entry = {"topic": topic, "time_ns": time.to_nsec(), "type": message._type}
    if hasattr(message, "header"):
        entry["frame"] = message.header.frame_id
    if message._type == "sensor_msgs/PointCloud2":
        entry.update(points=message.width * message.height, point_100=point(message, 100))
    elif message._type == "sensor_msgs/Image":
        entry.update(width=message.width, height=message.height, fourth_byte=message.data[3])
    elif message._type == "sensor_msgs/CameraInfo":
        entry.update(model=message.distortion_model, D=list(message.D), K=list(message.K))
    elif message._type == "geometry_msgs/PoseStamped":
        entry.update(pose(message.pose.position, message.pose.orientation))
    elif message._type == "tf2_msgs/TFMessage":
        entry["transforms"] = [
            dict(frame=t.header.frame_id, child=t.child_frame_id,
                 **pose(t.transform.translation, t.transform.rotation)) for t in message.transforms]
    return entry


with rosbag.Bag(sys.argv[1]) as bag:
    print(json.dumps([describe(*message) for message in bag.read_messages()]))
