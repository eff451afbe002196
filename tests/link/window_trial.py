#!/usr/bin/python3
"""The workstation's window at the far end of a bad link: a whole mission through blackouts, or STOP HEAD over a thin path.
Head, router and station are network namespaces. Needs root, iproute2, openssl and Xvfb.

    tests/link/window_trial.py --bin build/release/bin --runs 5 --seed 1            blackouts of up to 30 s, dark between
    tests/link/window_trial.py --bin build/release/bin --runs 5 --seed 1 --thin     9600 bit/s each way, nothing else

The window is that of tests/display/linked_mission_test.cpp: it homes the head, scans the room, shows it, finds the valve in
a region drawn with the mouse, accepts it and sends it to a robot (docs/examples/robot_receiver.py) that answers; with
--thin it presses STOP HEAD 9 s into a sweep whose data fill the path, and the head's log says when the stop was there.
One line of JSON a run. Exit 0 when every mission got the robot's answer and its scans have the head's digests, or every
stop was at the head within --bar-s.
"""
import argparse
import datetime
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

import blackout_trial
import burst_trial
from blackout_trial import HEAD, PORT, make_link_keys
from soak import Blackouts, digests
from thin_trial import moment

PROJECT = pathlib.Path(__file__).resolve().parents[2]


def seconds_of_day(utc_s):
    at = datetime.datetime.fromtimestamp(utc_s)
    return at.hour * 3600 + at.minute * 60 + at.second + 1e-6 * at.microsecond


def mounted_rig(arguments, file):
    """The emulated head's rig, with its place on the robot typed in: the robot takes poses in its own frame only."""
    blackout_trial.run(arguments.bin / "foresightctl", "rig", "set-robot-frame", PROJECT / "resources/rigs/default.yaml", "--position",
                       "0.1,0,1.4", "--quaternion", "-0.5,0.5,-0.5,0.5", "--out", file)
    return file


def one_run(arguments, seed, folder):
    name = f"fsw{os.getpid() % 1000}"
    network = burst_trial.Network(name, arguments.bit, 1) if arguments.thin else blackout_trial.Network(name, arguments.mbit)
    processes, blackouts = [], None
    environment = dict(os.environ, XDG_STATE_HOME=str(folder / "state"), XDG_CONFIG_HOME=str(folder / "config"),
                       XDG_DATA_HOME=str(folder / "data"), FORESIGHT_TRIAL_HEAD=HEAD,
                       FORESIGHT_TRIAL_KEYS=str(arguments.keys / "ca/machines/anna"),
                       FORESIGHT_TRIAL_MISSION=str(folder / "station.foresight"),
                       FORESIGHT_TRIAL_THIN="1" if arguments.thin else "")
    environment.pop("DISPLAY", None)
    try:
        head_log = folder / "head.log"
        processes.append(subprocess.Popen(
            ["ip", "netns", "exec", f"{name}-h", arguments.bin / "foresight-head", "--emulate", arguments.scene, "--seed",
             str(seed), "--calibration", arguments.rig, "--listen", f"{HEAD}:{PORT}", "--link-keys", arguments.keys / "ca/machines/trial", "--scans",
             folder / "head-scans", "--robot-socket", folder / "robot.sock"],
            stdout=open(head_log, "w"), stderr=subprocess.STDOUT))
        while "listening" not in head_log.read_text():
            time.sleep(0.05)
        robot_log = folder / "robot.log"
        processes.append(subprocess.Popen(
            [sys.executable, PROJECT / "docs/examples/robot_receiver.py", folder / "robot.sock"],
            stdout=open(robot_log, "w"), stderr=subprocess.STDOUT))
        if not arguments.thin:
            blackouts = Blackouts(network, random.Random(seed), arguments)
        test = "StopHead*" if arguments.thin else "AMission*"
        window = subprocess.run(
            ["ip", "netns", "exec", f"{name}-s", PROJECT / "tests/display/with_display.sh", arguments.bin / "test_display",
             f"--gtest_filter=LinkedWindow.{test}"], capture_output=True, text=True, env=environment, timeout=arguments.limit_s)
        (folder / "window.log").write_text(window.stdout + window.stderr)
        told = [line for line in window.stdout.splitlines() if line.startswith("TRIAL ")]
        outcome = {"seed": seed, "window_exit": window.returncode, **json.loads(told[0][6:] if told else "{}")}
        if arguments.thin:
            at_head = moment(head_log, "stopped the head")
            if at_head is not None and "stop_pressed_utc_s" in outcome:
                outcome["stop_at_head_after_s"] = round(at_head - seconds_of_day(outcome["stop_pressed_utc_s"]), 2)
                outcome["stop_shown_after_s"] = round(outcome["stop_seen_utc_s"] - outcome["stop_pressed_utc_s"], 2)
            outcome["well"] = window.returncode == 0 and outcome.get("stop_at_head_after_s", 1e9) <= arguments.bar_s
        else:
            there = [d for file in (folder / "head-scans").glob("*.foresight") for d in digests(arguments, file)]
            outcome["identical"] = sorted(digests(arguments, folder / "station.foresight")) == sorted(there)
            outcome["robot_heard"] = len(robot_log.read_text().splitlines())
            outcome["well"] = window.returncode == 0 and outcome["identical"] and outcome["robot_heard"] == 1
        if window.returncode:
            outcome["said"] = [line for line in window.stdout.splitlines() if "Failure" in line or "rror" in line][:8]
        return outcome
    finally:
        if blackouts:
            blackouts.ended = True
            blackouts.join()
        for process in processes:
            process.kill()
        network.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path("build/release/bin"))
    parser.add_argument("--scene", type=pathlib.Path, default=PROJECT / "resources/scenes/room.yaml")
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--thin", action="store_true", help="9600 bit/s and STOP HEAD in place of blackouts and a mission")
    parser.add_argument("--bit", type=int, default=9600, help="a second, each way, of the thin path")
    parser.add_argument("--bar-s", type=float, default=3.0, help="for the stop over the thin path")
    parser.add_argument("--mbit", type=float, default=300.0, help="of the open window")
    parser.add_argument("--window-s", type=float, default=1.0)
    parser.add_argument("--shortest-s", type=float, default=1.0, help="blackout")
    parser.add_argument("--longest-s", type=float, default=30.0, help="blackout")
    parser.add_argument("--limit-s", type=float, default=900.0)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for logs, missions and screenshots (default: a temporary one)")
    arguments = parser.parse_args()
    arguments.bin, arguments.scene = arguments.bin.resolve(), arguments.scene.resolve()
    if os.geteuid() != 0 or not shutil.which("ip") or not shutil.which("xvfb-run"):
        print("window_trial: needs root, iproute2 and Xvfb", file=sys.stderr)
        return 77
    well = 0
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        arguments.keys = folder / "keys"
        arguments.keys.mkdir()
        make_link_keys(arguments)
        arguments.rig = mounted_rig(arguments, folder / "rig.yaml")
        for number in range(arguments.runs):
            here = folder / str(number)
            here.mkdir()
            outcome = one_run(arguments, arguments.seed + number, here)
            well += outcome["well"]
            print(json.dumps(outcome), flush=True)
    print(f"{well} of {arguments.runs} went well")
    return 0 if well == arguments.runs else 1


if __name__ == "__main__":
    sys.exit(main())
