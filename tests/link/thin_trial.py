#!/usr/bin/python3
"""A room scan, an early end of the sweep and a fit on the robot over a thin path alone, the same rate both ways. Head,
router and station are network namespaces. Needs root, iproute2 and openssl.

    tests/link/thin_trial.py --bin build/release/bin --scene resources/scenes/room.yaml --runs 10 --seed 1

For each run: how long after the sweep's first line at the head the first coarse cloud was at the station; how long
after the station was told to end the sweep (SIGINT, while the path was full of the scan's data) the head had done so;
and then, with a program of its own, a fit of the valve on the robot: seconds with connection and handshake, and the
bytes that crossed the path for it. Exit 0 when every first coarse cloud was there within --bar-s.
"""
import argparse
import datetime
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from blackout_trial import HEAD, PORT, make_link_keys
from burst_trial import Network

# The valve of the room, in the robot's frame.
FIT = ["fit", "valve", "--box", "1.4", "0.9", "1.3", "0.8", "0.8", "0.8"]


def moment(log, text):
    """When a log says something, in seconds of the day; None = it does not."""
    for line in log.read_text().splitlines():
        stamp = re.match(r"(\d\d:\d\d:\d\d\.\d+) ", line)
        if stamp and text in line:
            at = datetime.datetime.strptime(stamp.group(1), "%H:%M:%S.%f")
            return at.hour * 3600 + at.minute * 60 + at.second + 1e-6 * at.microsecond
    return None


def now():
    at = datetime.datetime.now()
    return at.hour * 3600 + at.minute * 60 + at.second + 1e-6 * at.microsecond


def wait_for(log, text, limit_s):
    end = time.time() + limit_s
    while time.time() < end:
        at = moment(log, text)
        if at is not None:
            return at
        time.sleep(0.02)
    return None


def one_run(arguments, seed, folder):
    network = Network(f"fst{os.getpid() % 1000}", arguments.bit, 1)
    processes = []
    environment = dict(os.environ, XDG_STATE_HOME=str(folder / "state"))

    def station(name, *command):
        return subprocess.Popen(
            ["ip", "netns", "exec", f"{network.name}-s", arguments.bin / "foresightctl", *command, "--head", HEAD,
             "--thin-link", "--link-keys", arguments.keys / "ca/machines/anna", "--json"],
            stdout=open(folder / f"{name}.json", "w"), stderr=open(folder / f"{name}.log", "w"), env=environment)

    try:
        head_log = folder / "head.log"
        processes.append(subprocess.Popen(
            ["ip", "netns", "exec", f"{network.name}-h", arguments.bin / "foresight-head", "--emulate", arguments.scene,
             "--seed", str(seed), "--listen", f"{HEAD}:{PORT}", "--link-keys", arguments.keys / "ca/machines/trial",
             "--scans", folder / "head-scans"], stdout=open(head_log, "w"), stderr=subprocess.STDOUT))
        while "listening" not in head_log.read_text():
            time.sleep(0.05)
        scan = station("scan", "scan", "--from", "-30", "--to", "80", "--images", "0,20,40", "--out",
                       folder / "station.foresight")
        processes.append(scan)
        first_line = wait_for(head_log, "the first line is here", 60)
        coarse = wait_for(folder / "scan.log", "the first coarse cloud is here", 60)
        if first_line is None or coarse is None:
            return {"seed": seed, "faults": "no first line or no coarse cloud",
                    "logs": head_log.read_text()[-800:] + (folder / "scan.log").read_text()[-800:]}
        time.sleep(max(0.0, first_line + arguments.stop_after_s - now()))
        told = now()
        scan.send_signal(signal.SIGINT)
        stopped = wait_for(head_log, "is to end", 30)
        scan.wait(timeout=60)
        down, up = network.counts("s", "st0")
        began = time.time()
        fit = station("fit", *FIT)
        processes.append(fit)
        code = fit.wait(timeout=120)
        fit_s = time.time() - began
        down_then, up_then = network.counts("s", "st0")
        found = json.loads((folder / "fit.json").read_text() or "{}")
        return {"seed": seed, "coarse_after_s": round(coarse - first_line, 2),
                "stopped_after_s": stopped and round(stopped - told, 2), "fit_exit": code, "fit_s": round(fit_s, 1),
                "verdict": found.get("verdict"), "fit_messages": found.get("link_bytes"),
                "fit_path_bytes": {"up": up_then - up, "down": down_then - down}}
    finally:
        for process in processes:
            if process.poll() is None:
                process.kill()
        network.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path("build/release/bin"))
    parser.add_argument("--scene", type=pathlib.Path, default=pathlib.Path("resources/scenes/room.yaml"))
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--bit", type=int, default=9600, help="a second, each way")
    parser.add_argument("--stop-after-s", type=float, default=9.0, help="of the first line")
    parser.add_argument("--bar-s", type=float, default=5.0, help="for the first coarse cloud")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for logs and missions (default: a temporary one)")
    arguments = parser.parse_args()
    arguments.bin, arguments.scene = arguments.bin.resolve(), arguments.scene.resolve()
    if os.geteuid() != 0 or not shutil.which("ip"):
        print("thin_trial: needs root and iproute2 for network namespaces", file=sys.stderr)
        return 77
    outcomes = []
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        arguments.keys = folder / "keys"
        arguments.keys.mkdir()
        make_link_keys(arguments)
        for number in range(arguments.runs):
            here = folder / str(number)
            here.mkdir()
            outcomes.append(one_run(arguments, arguments.seed + number, here))
            print(json.dumps(outcomes[-1]), flush=True)
    early = sum(outcome.get("coarse_after_s", 1e9) <= arguments.bar_s for outcome in outcomes)
    print(f"{early} of {len(outcomes)} first coarse clouds within {arguments.bar_s:g} s")
    return 0 if early == len(outcomes) else 1


if __name__ == "__main__":
    sys.exit(main())
