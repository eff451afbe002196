#!/usr/bin/python3
"""Scans through blackouts for half an hour, with observers who come and go: whether the head's program stays as it is.
Head, router and station are network namespaces. Needs root, iproute2 and openssl.

    tests/link/soak.py --bin build/release/bin --scene resources/scenes/room.yaml --minutes 30 --seed 1

One line of JSON a scan and one for the whole: memory, threads and open files of foresight-head in each tenth of the time
(medians), and at rest, with nobody connected, after a first scan and in the end. In between they depend on who is there:
a station that a blackout cut off has its thread and its socket until the keepalive gives up. Exit 0 when every scan that
began is in the end in the station's mission with the head's digest, the head's memory grew by less than --growth-mb from
the second tenth to the last, and at rest it has no more threads of its own and files than before.
"""
import argparse
import json
import os
import pathlib
import random
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time

from blackout_trial import HEAD, PORT, Network, make_link_keys, run

OWN_THREADS = "foresight-head"  # those that nobody has given a name
SCAN = ["scan", "--from", "-15", "--to", "15", "--images", "0,10"]


class Watcher(threading.Thread):
    """What a process takes, twice a second."""

    def __init__(self, pid):
        super().__init__(daemon=True)
        self.pid, self.samples, self.ended = pid, [], False
        self.start()

    def run(self):
        while not self.ended:
            try:
                status = pathlib.Path(f"/proc/{self.pid}/status").read_text()
                files = len(os.listdir(f"/proc/{self.pid}/fd"))
            except OSError:
                return
            field = lambda name: int(status.split(name + ":")[1].split()[0])
            self.samples.append((time.time(), field("VmRSS") / 1024, field("Threads"), files))
            time.sleep(0.5)

    def medians(self, begin, end):
        """Between two ratios of the time."""
        first, last = self.samples[0][0], self.samples[-1][0]
        inside = [s[1:] for s in self.samples if begin <= (s[0] - first) / (last - first) <= end]
        memory, threads, files = (statistics.median(column) for column in zip(*inside))
        return {"memory_mb": round(memory, 1), "threads": threads, "open_files": files}


    def threads_by_name(self):
        """gRPC names its own: how many of those it keeps is its affair."""
        names = [(task / "comm").read_text().strip() for task in pathlib.Path(f"/proc/{self.pid}/task").iterdir()]
        return {name: names.count(name) for name in sorted(set(names))}

    def files_by_kind(self):
        """Sockets, event counters of libraries, files by their names: what grows is to have a name."""
        kinds = []
        for descriptor in pathlib.Path(f"/proc/{self.pid}/fd").iterdir():
            try:
                kinds.append(os.readlink(descriptor).split(":[")[0])
            except OSError:
                pass  # closed meanwhile
        return {kind: kinds.count(kind) for kind in sorted(set(kinds))}

    def at_rest(self, longest_s=120.0, unchanged_s=25.0):
        """When nothing has changed for longer than the head keeps a connection that says nothing (keepalive 10 + 10 s, a
        handshake 20 s): before that, sockets of stations that a blackout cut off are still open."""
        end = time.time() + longest_s
        while time.time() < end:
            time.sleep(1.0)
            last = [s[2:] for s in self.samples if s[0] > time.time() - unchanged_s]
            if len(set(last)) == 1 and len(last) > unchanged_s:
                break
        files = self.files_by_kind()
        return {"threads": self.threads_by_name(), "open_files": sum(files.values()), "files": files}


class Blackouts(threading.Thread):
    def __init__(self, network, rng, arguments):
        super().__init__(daemon=True)
        self.network, self.rng, self.arguments, self.ended = network, rng, arguments, False
        self.start()

    def run(self):
        while not self.ended:
            self.network.open(False)
            time.sleep(self.rng.uniform(self.arguments.shortest_s, self.arguments.longest_s))
            self.network.open(True)
            time.sleep(self.arguments.window_s)


class Observers(threading.Thread):
    """Up to three at a time, for a second to fifteen each."""

    def __init__(self, start, rng):
        super().__init__(daemon=True)
        self.start_one, self.rng, self.ended, self.count = start, rng, False, 0
        self.start()

    def run(self):
        there = []
        while not self.ended:
            for process, end in list(there):
                if process.poll() is not None or time.time() > end:
                    process.kill()
                    process.wait()
                    there.remove((process, end))
            if len(there) < 3:
                there.append((self.start_one(), time.time() + self.rng.uniform(1.0, 15.0)))
                self.count += 1
            time.sleep(self.rng.uniform(0.5, 3.0))
        for process, _ in there:
            process.kill()
            process.wait()


def digests(arguments, mission):
    shown = subprocess.run([arguments.bin / "foresightctl", "mission", "digest", mission, "--json"], capture_output=True,
                           text=True)
    return [scan["digest"] for scan in json.loads(shown.stdout or "{}").get("scans", [])]


def soak(arguments, folder):
    rng = random.Random(arguments.seed)
    network = Network(f"fsk{os.getpid() % 1000}", arguments.mbit)
    environment = dict(os.environ, XDG_STATE_HOME=str(folder / "state"))
    log = open(folder / "station.log", "w")

    def station(who, *command):
        return subprocess.Popen(
            ["ip", "netns", "exec", f"{network.name}-s", arguments.bin / "foresightctl", *command, "--head", HEAD,
             "--link-keys", arguments.keys / f"ca/machines/{who}"], stdout=log, stderr=log, env=environment)

    head = subprocess.Popen(
        ["ip", "netns", "exec", f"{network.name}-h", arguments.bin / "foresight-head", "--emulate", arguments.scene, "--seed",
         str(arguments.seed), "--listen", f"{HEAD}:{PORT}", "--link-keys", arguments.keys / "ca/machines/trial", "--scans",
         folder / "head-scans", "--no-announce"], stdout=open(folder / "head.log", "w"), stderr=subprocess.STDOUT)
    try:
        while "listening" not in (folder / "head.log").read_text():
            time.sleep(0.05)
        pid = int(run("pgrep", "-f", f"foresight-head.*{folder}").stdout.split()[0])
        watcher = Watcher(pid)
        mission, codes = folder / "station.foresight", []
        station("anna", *SCAN, "--out", mission).wait()
        before = watcher.at_rest()
        blackouts = Blackouts(network, rng, arguments)
        observers = Observers(lambda: station("otto", "fetch", "--list"), random.Random(arguments.seed + 1))
        end = time.time() + 60 * arguments.minutes
        while time.time() < end:
            began = time.time()
            codes.append(station("anna", *SCAN, "--out", mission).wait())
            print(json.dumps({"scan": len(codes), "exit": codes[-1], "seconds": round(time.time() - began, 1),
                              "memory_mb": round(watcher.samples[-1][1])}), flush=True)
        blackouts.ended = observers.ended = True
        blackouts.join()
        observers.join()
        network.open(True)
        station("anna", "fetch", "--out", mission).wait()
        after = watcher.at_rest()
        watcher.ended = True
        here = sorted(digests(arguments, mission))
        there = sorted(d for file in (folder / "head-scans").glob("*.foresight") for d in digests(arguments, file))
        tenths = [watcher.medians(0.1 * i, 0.1 * (i + 1)) for i in range(10)]
        whole = {"scans": len(codes), "exit_0": codes.count(0), "observers": observers.count, "identical": here == there,
                 "tenths": tenths, "at_rest_before": before, "at_rest_after": after}
        print(json.dumps(whole))
        return (here == there and tenths[9]["memory_mb"] - tenths[1]["memory_mb"] < arguments.growth_mb
                and after["open_files"] <= before["open_files"]
                and after["threads"][OWN_THREADS] <= before["threads"][OWN_THREADS])
    finally:
        head.kill()
        network.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path("build/release/bin"))
    parser.add_argument("--scene", type=pathlib.Path, default=pathlib.Path("resources/scenes/room.yaml"))
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mbit", type=float, default=300.0, help="of the open window")
    parser.add_argument("--window-s", type=float, default=1.0)
    parser.add_argument("--shortest-s", type=float, default=1.0, help="blackout")
    parser.add_argument("--longest-s", type=float, default=30.0, help="blackout")
    parser.add_argument("--growth-mb", type=float, default=10.0)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for logs and missions (default: a temporary one)")
    arguments = parser.parse_args()
    arguments.bin, arguments.scene = arguments.bin.resolve(), arguments.scene.resolve()
    if os.geteuid() != 0 or not shutil.which("ip"):
        print("soak: needs root and iproute2 for network namespaces", file=sys.stderr)
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        arguments.keys = folder / "keys"
        arguments.keys.mkdir()
        make_link_keys(arguments)
        run(arguments.bin / "foresightctl", "pki", "observer", "otto", "--pki", arguments.keys / "ca")
        return 0 if soak(arguments, folder) else 1


if __name__ == "__main__":
    sys.exit(main())
