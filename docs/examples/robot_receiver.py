#!/usr/bin/env python3
"""Takes poses from foresight-head and answers each (docs/protocols.md, "To the robot")."""
import json, os, socket, sys, time


def judge(pose):
    """What this robot makes of a pose: the answer, and why."""
    if pose["frame"] != "robot":
        return "refused", "the rig does not know how the head is mounted on the robot"
    if pose["object"] not in ("valve", "drill"):
        return "refused", f"no plan for a {pose['object']}"
    return "accepted", ""


def serve(head, answers):
    for line in head.makefile("r", encoding="utf-8"):
        pose = json.loads(line)
        if "id" not in pose:  # the head says why it closes the connection
            sys.exit(pose.get("error", "a line without an id"))
        if pose["id"] not in answers:  # a pose that comes twice is carried out once
            answers[pose["id"]] = judge(pose)
            print(*answers[pose["id"]], pose["id"], pose["position_m"], flush=True)
        answer, reason = answers[pose["id"]]
        reply = {"id": pose["id"], "answer": answer, "reason": reason}
        head.sendall((json.dumps(reply) + "\n").encode())


path = sys.argv[1] if len(sys.argv) > 1 else os.environ["XDG_RUNTIME_DIR"] + "/foresight/robot.sock"
known = {}
while True:  # a head that is restarted is found again
    try:
        with socket.socket(socket.AF_UNIX) as connection:
            connection.connect(path)
            serve(connection, known)
    except OSError as failure:
        print(f"{path}: {failure}", file=sys.stderr)
    time.sleep(1)
