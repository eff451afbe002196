#!/usr/bin/python3
"""A room scan over two paths at once: a thin one both ways that is always open (the link), and a wide one from head to
station alone that opens for a second at a time (bursts). Head, router and station are network namespaces. Needs root,
iproute2 and openssl.

    tests/link/burst_trial.py --bin build/release/bin --scene resources/scenes/room.yaml --runs 5 --seed 1

For each run: whether the station's scan has the head's digest, when it was whole, and for each window how many bytes
came to the station, of those that the path's token bucket lets through. The carousel stops when the station has all, so
windows count while there was more to send. Exit 0 when every scan arrived whole.
"""
import argparse
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

from blackout_trial import HEAD, PORT, STATION, make_link_keys, run

WIDE_HEAD, WIDE_STATION = "10.77.3.2", "10.77.4.2"
BURST_PORT = 47131
BUCKET = 256 * 1024


class Network:
    """Namespaces head - router - station, with a thin path through the router and a wide one."""

    def __init__(self, name, bit, mbit):
        self.name = name
        self.close()  # what a run that was killed left
        for space in self.spaces():
            run("ip", "netns", "add", space)
        self.within("r", "sysctl", "-qw", "net.ipv4.ip_forward=1")
        thin = ("rate", f"{bit}bit", "burst", "1540", "limit", "6kb")
        wide = ("rate", f"{mbit}mbit", "burst", "256kb", "latency", "50ms")
        self.join("h", "t", HEAD, thin)
        self.join("s", "t", STATION, thin)
        self.join("h", "w", WIDE_HEAD, wide)
        self.join("s", "w", WIDE_STATION, wide)
        self.within("h", "ip", "route", "add", "10.77.2.0/24", "via", HEAD[:-1] + "1")
        self.within("h", "ip", "route", "add", "10.77.4.0/24", "via", WIDE_HEAD[:-1] + "1")
        self.within("s", "ip", "route", "add", "10.77.1.0/24", "via", STATION[:-1] + "1")
        self.within("s", "ip", "route", "add", "10.77.3.0/24", "via", WIDE_STATION[:-1] + "1")
        # One way: what comes to the router from the station's wide interface goes nowhere, ever.
        self.within("r", "sysctl", "-qw", "net.ipv4.conf.sw1.forwarding=0")
        self.open(False)

    def spaces(self):
        return [f"{self.name}-{part}" for part in ("h", "r", "s")]

    def join(self, end, path, address, bucket):
        """The interface `path`0 of an end, and its other side at the router; a bucket at both."""
        run("ip", "link", "add", f"{end}{path}0", "netns", f"{self.name}-{end}", "type", "veth", "peer", "name",
            f"{end}{path}1", "netns", f"{self.name}-r")
        self.within(end, "ip", "addr", "add", f"{address}/24", "dev", f"{end}{path}0")
        self.within("r", "ip", "addr", "add", f"{address[:-1]}1/24", "dev", f"{end}{path}1")
        self.within(end, "ip", "link", "set", "lo", "up")
        for part, side in ((end, 0), ("r", 1)):
            self.within(part, "ip", "link", "set", f"{end}{path}{side}", "up")
        sides = ((end, 0), ("r", 1)) if path == "t" else (("r", 1),)
        for part, side in sides:
            self.within(part, "tc", "qdisc", "add", "dev", f"{end}{path}{side}", "root", "tbf", *bucket)

    def within(self, part, *command):
        return run("ip", "netns", "exec", f"{self.name}-{part}", *command)

    def open(self, is_open):
        self.within("r", "sysctl", "-qw", f"net.ipv4.conf.hw1.forwarding={int(is_open)}")

    def counts(self, part, device):
        """Bytes received and sent so far."""
        shown = self.within(part, "cat", "/proc/net/dev").stdout
        fields = next(line for line in shown.splitlines() if f"{device}:" in line).split(":")[1].split()
        return int(fields[0]), int(fields[8])

    def close(self):
        for space in self.spaces():
            subprocess.run(["ip", "netns", "del", space], capture_output=True)


class Sampler(threading.Thread):
    """How many bytes came on the station's wide interface, two hundred times a second."""

    def __init__(self, network):
        super().__init__(daemon=True)
        self.samples = []
        self.counter = subprocess.Popen(
            ["ip", "netns", "exec", f"{network.name}-s", sys.executable, "-u", "-c",
             "import time\nwhile True:\n line = [l for l in open('/proc/net/dev') if 'sw0:' in l][0]\n"
             " print(time.time(), line.split(':')[1].split()[0]); time.sleep(0.005)"],
            stdout=subprocess.PIPE, text=True)
        self.start()

    def run(self):
        for line in self.counter.stdout:
            moment, count = line.split()
            self.samples.append((float(moment), int(count)))

    def stop(self):
        self.counter.kill()
        self.join()

    def within(self, begin, end, least):
        """Bytes in all; when the first came; until when at least `least` bytes a second came, over 50 ms, and how many
        had come by then."""
        inside = [sample for sample in self.samples if begin <= sample[0] <= end]
        first = next((b[0] for a, b in zip(inside, inside[1:]) if b[1] - a[1] > 1000), None)
        if first is None:
            return 0, None, begin, 0
        until, by_then = first, 0
        for i in range(10, len(inside)):
            (then, before), (now, count) = inside[i - 10], inside[i]
            if count - before >= least * (now - then):
                until, by_then = now, count - inside[0][1]
        return inside[-1][1] - inside[0][1], first, until, by_then


def describe(sampler, begin, end, mbit):
    """A window. The ratio is of what the bucket lets through, until what came fell below half of the rate: then the head
    had little more to send."""
    rate = mbit * 1e6 / 8
    count, first, until, by_then = sampler.within(begin - 0.005, end + 0.1, rate / 2)
    if first is None:
        return {"megabytes": 0.0}
    until = min(until, end)
    return {"megabytes": round(count / 1e6, 2), "first_s": round(first - begin, 3), "full_for_s": round(until - begin, 3),
            "ratio": round(by_then / (rate * (until - begin) + BUCKET), 3) if by_then else None}


def start(arguments, network, seed, folder):
    head_log = open(folder / "head.log", "w")
    head = subprocess.Popen(
        ["ip", "netns", "exec", f"{network.name}-h", arguments.bin / "foresight-head", "--emulate", arguments.scene,
         "--seed", str(seed), "--listen", f"{HEAD}:{PORT}", "--link-keys", arguments.keys / "ca/machines/trial",
         "--scans", folder / "head-scans", "--burst-rate", str(arguments.burst_rate)], stdout=head_log, stderr=head_log)
    deadline = time.time() + 20
    while "listening" not in (folder / "head.log").read_text() and time.time() < deadline:
        time.sleep(0.05)
    environment = dict(os.environ, XDG_STATE_HOME=str(folder / "state"))
    station = subprocess.Popen(
        ["ip", "netns", "exec", f"{network.name}-s", arguments.bin / "foresightctl", "scan", "--head", HEAD,
         "--thin-link", "--burst-port", f"{WIDE_STATION}:{BURST_PORT}", "--link-keys",
         arguments.keys / "ca/machines/anna", "--from", "-30", "--to", "80", "--images",
         "-30,-20,-10,0,10,20,30,40,50,60,70,80", "--out", folder / "station.foresight", "--json"],
        stdout=open(folder / "station.json", "w"), stderr=open(folder / "station.log", "w"), env=environment)
    return head, station


def digests(arguments, folder):
    found = []
    for mission in [folder / "station.foresight", *sorted((folder / "head-scans").glob("*.foresight"))]:
        shown = subprocess.run([arguments.bin / "foresightctl", "mission", "digest", mission, "--json"],
                               capture_output=True, text=True)
        found += [scan["digest"] for scan in json.loads(shown.stdout or "{}").get("scans", [])]
    return found


def one_run(arguments, seed, folder):
    rng = random.Random(seed)
    network = Network(f"fsb{os.getpid() % 1000}", arguments.bit, arguments.mbit)
    processes = []
    try:
        processes = head, station = start(arguments, network, seed, folder)
        sampler = Sampler(network)
        began = time.time()
        windows = []
        while station.poll() is None and time.time() - began < arguments.limit_s:
            wait = time.time() + rng.uniform(arguments.shortest_s, arguments.longest_s)
            while time.time() < wait and station.poll() is None:
                time.sleep(0.05)
            if station.poll() is not None:
                break
            begin = time.time()
            network.open(True)
            time.sleep(arguments.window_s)
            network.open(False)
            windows.append((begin, time.time()))
        seconds = time.time() - began
        code = station.poll()
        if code is None:
            station.send_signal(signal.SIGINT)
            station.wait(timeout=30)
        received, sent = network.counts("s", "st0")
        time.sleep(0.2)
        sampler.stop()
        looks = [describe(sampler, a, b, arguments.mbit) for a, b in windows]
        found = digests(arguments, folder)
        came = re.search(r"burst path: (.*)", (folder / "station.log").read_text())
        return {"seed": seed, "exit": code, "seconds": round(seconds, 1), "windows_at_s": [round(a - began, 1) for a, _ in windows],
                "windows": looks, "thin_bytes_down": received, "thin_bytes_up": sent,
                "burst": came.group(1) if came else None, "identical": len(found) == 2 and found[0] == found[1]}
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
    parser.add_argument("--bit", type=int, default=9600, help="a second of the thin path, each way")
    parser.add_argument("--mbit", type=float, default=300.0, help="a second of the wide path")
    parser.add_argument("--burst-rate", type=float, default=285.0, help="Mbit/s that the head sends at")
    parser.add_argument("--window-s", type=float, default=1.0)
    parser.add_argument("--shortest-s", type=float, default=10.0, help="gap before a window")
    parser.add_argument("--longest-s", type=float, default=30.0, help="gap before a window")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for logs and missions (default: a temporary one)")
    parser.add_argument("--limit-s", type=float, default=240.0)
    arguments = parser.parse_args()
    arguments.bin = arguments.bin.resolve()
    arguments.scene = arguments.scene.resolve()
    if os.geteuid() != 0 or not shutil.which("ip"):
        print("burst_trial: needs root and iproute2 for network namespaces", file=sys.stderr)
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
            outcome = one_run(arguments, arguments.seed + number, here)
            print(json.dumps(outcome), flush=True)
            if not outcome["identical"]:
                for log in ("head.log", "station.log"):
                    print((here / log).read_text()[-1500:], file=sys.stderr)
            outcomes.append(outcome)
    whole = sum(outcome["identical"] for outcome in outcomes)
    ratios = [window["ratio"] for outcome in outcomes for window in outcome["windows"] if window.get("ratio")]
    print(f"{whole} of {len(outcomes)} scans identical; of {len(ratios)} windows the least used was used to "
          f"{min(ratios, default=0.0):.2f}, in the middle {sorted(ratios)[len(ratios) // 2] if ratios else 0.0:.2f}")
    return 0 if whole == len(outcomes) else 1


if __name__ == "__main__":
    sys.exit(main())
