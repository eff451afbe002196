#!/usr/bin/python3
"""kill -9 of the head's or the station's program at a random moment of a scan over the link, then a restart of it.

    tests/link/kill_trial.py --bin build/release/bin --scene resources/scenes/room.yaml --runs 50 --seed 1

For each run: a head on loopback, a station that scans and then fetches what it does not have whole. One of the two dies
at a moment between the station's start and the end of what it does. Afterwards the station fetches what the head has.
Required: the station's mission has the head's scans, each once and with the head's digest; each line that the station's
spool or mission had when something died is still there; a scan that was cut short has its first lines without a gap.
Exit 0 when that holds for every run.
"""
import argparse
import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time

SCAN = ["scan", "--from", "-15", "--to", "15", "--images", "-10,0,10"]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Trial:
    def __init__(self, arguments, seed, folder):
        self.bin, self.scene, self.seed, self.folder = arguments.bin, arguments.scene, seed, folder
        self.port = free_port()
        self.mission = folder / "station.foresight"
        self.log = open(folder / "programs.log", "ab")

    def start_head(self):
        head = subprocess.Popen(
            [self.bin / "foresight-head", "--emulate", self.scene, "--seed", str(self.seed), "--listen",
             f"127.0.0.1:{self.port}", "--plaintext", "--no-announce", "--scans", self.folder / "scans"],
            stdout=self.log, stderr=self.log)
        deadline = time.time() + 20
        while time.time() < deadline:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", self.port)) == 0:
                    return head
            time.sleep(0.02)
        raise RuntimeError("the head does not listen")

    def start_station(self, *command):
        environment = dict(os.environ, XDG_STATE_HOME=str(self.folder / "state"))
        return subprocess.Popen(
            [self.bin / "foresightctl", *command, "--head", f"127.0.0.1:{self.port}", "--plaintext", "--out",
             self.mission], stdout=self.log, stderr=self.log, env=environment)

    def scans(self, mission):
        """uuid -> digest, state and number of lines of a mission's scans."""
        if not mission.exists():
            return []
        shown = subprocess.run([self.bin / "foresightctl", "mission", "digest", mission, "--json"],
                               capture_output=True, text=True)
        return json.loads(shown.stdout or "{}").get("scans", [])

    def run(self, station_s):
        """`station_s`: how long a scan takes when nobody dies."""
        rng = random.Random(self.seed)
        victim = rng.choice(["head", "station"])
        moment_s = rng.uniform(0.0, station_s)
        head = self.start_head()
        station = self.start_station(*SCAN)
        try:
            time.sleep(moment_s)
            (head if victim == "head" else station).kill()
            if victim == "head":
                head.wait()
                head = self.start_head()
                # It goes on by itself, or says that the scan was cut short.
                station.send_signal(signal.SIGINT)
            station.wait(timeout=60)
            before = self.scans(self.mission)
            # The head may still sweep for a station that died: a scan is fetched to its end.
            fetched = None
            for _ in range(3):
                fetched = self.start_station("fetch").wait(timeout=90)
                if fetched == 0 and not self.running_on_head():
                    break
                time.sleep(0.5)
            head.send_signal(signal.SIGTERM)
            head.wait(timeout=30)
            return self.judge(victim, moment_s, before, fetched)
        finally:
            for process in (head, station):
                if process.poll() is None:
                    process.kill()

    def running_on_head(self):
        return any(scan["state"] == "running" for file in (self.folder / "scans").glob("*.foresight")
                   for scan in self.scans(file))

    def judge(self, victim, moment_s, before, fetched):
        there = [scan for file in (self.folder / "scans").glob("*.foresight") for scan in self.scans(file)]
        here = self.scans(self.mission)
        digests = {scan["uuid"]: scan["digest"] for scan in here}
        lines = {scan["uuid"]: scan["lines"] for scan in here}
        faults = []
        if sorted(digests.items()) != sorted((scan["uuid"], scan["digest"]) for scan in there):
            faults.append("the station's scans are not the head's")
        if len(digests) != len(here):
            faults.append("a scan is there twice")
        if any(lines.get(scan["uuid"], 0) < scan["lines"] for scan in before):
            faults.append("lines that had come are lost")
        if there and fetched != 0:
            faults.append(f"fetch ended with {fetched}")
        if any(scan["gaps"] for scan in here):
            faults.append("lines are missing between others")
        left = list(self.folder.glob("station.foresight.spool/*"))
        if left:
            faults.append("a spool was left")
        states = [f"{scan['state']} {scan['lines']}" for scan in there]
        return {"seed": self.seed, "killed": victim, "after_s": round(moment_s, 2), "scans": states,
                "lines_before": [scan["lines"] for scan in before], "faults": faults}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path("build/release/bin"))
    parser.add_argument("--scene", type=pathlib.Path, default=pathlib.Path("resources/scenes/room.yaml"))
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for logs and missions (default: a temporary one)")
    parser.add_argument("--station-s", type=float, help="latest moment of a death (default: as long as a scan takes)")
    arguments = parser.parse_args()
    arguments.bin, arguments.scene = arguments.bin.resolve(), arguments.scene.resolve()
    bad = 0
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.keep or pathlib.Path(name)
        station_s = arguments.station_s
        if station_s is None:
            (folder / "whole").mkdir(parents=True)
            whole = Trial(arguments, arguments.seed, folder / "whole")
            head, began = whole.start_head(), time.time()
            code = whole.start_station(*SCAN).wait(timeout=120)
            station_s = time.time() - began
            head.kill()
            if code != 0:
                print(f"kill_trial: a scan without a death ended with {code}", file=sys.stderr)
                return 3
        for number in range(arguments.runs):
            here = folder / str(number)
            here.mkdir(parents=True)
            outcome = Trial(arguments, arguments.seed + number, here).run(station_s)
            print(json.dumps(outcome), flush=True)
            if outcome["faults"]:
                bad += 1
                print((here / "programs.log").read_text()[-3000:], file=sys.stderr)
    print(f"{arguments.runs - bad} of {arguments.runs} deaths lost nothing and doubled nothing (moments up to "
          f"{station_s:.1f} s)")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
