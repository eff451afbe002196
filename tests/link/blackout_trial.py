#!/usr/bin/python3
"""A room scan through blackouts: head and station in network namespaces, with a router between them that forwards
for a second at a time. Needs root, iproute2 and openssl; addresses are those of the namespaces alone.

    tests/link/blackout_trial.py --bin build/release/bin --scene resources/scenes/room.yaml --runs 20 --seed 1

For each run: whether the station's scan has the head's digest, how much of each open window was used, and when the
scan was whole, and how long head and station computed and waited for a core (where they wait long, the machine is
what limits them). A window's use is the bytes that the station's interface received in it, over those that a plain sender
without a connection (UDP) brought through a window of the same length in the same run. Windows that began when
less was left to come than they let through had not enough to send and are left out. Exit 0 when every scan arrived whole and every window was used to 90 %.
"""
import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

PORT = 47130
HEAD, STATION = "10.77.1.2", "10.77.2.2"


def run(*command, **kwargs):
    return subprocess.run(command, check=True, capture_output=True, text=True, **kwargs)


class Network:
    """Namespaces head - router - station; both ways through the router at one rate."""

    def __init__(self, name, mbit):
        self.name = name
        self.close()  # what a run that was killed left
        for space in self.spaces():
            run("ip", "netns", "add", space)
        self.join("h", HEAD, "10.77.1.1", mbit)
        self.join("s", STATION, "10.77.2.1", mbit)
        self.open(True)

    def spaces(self):
        return [f"{self.name}-{part}" for part in ("h", "r", "s")]

    def join(self, part, address, router, mbit):
        end, middle = f"{self.name}-{part}", f"{self.name}-r"
        run("ip", "link", "add", f"v{part}0", "netns", end, "type", "veth", "peer", "name", f"v{part}1", "netns", middle)
        self.within(end, "ip", "addr", "add", f"{address}/24", "dev", f"v{part}0")
        self.within(middle, "ip", "addr", "add", f"{router}/24", "dev", f"v{part}1")
        for space, device in ((end, f"v{part}0"), (middle, f"v{part}1")):
            # Each packet is one of a wire, and counts with its headers: no segments that are cut up later.
            self.within(space, "ip", "link", "set", "dev", device, "gso_max_segs", "1")
        for space, device in ((end, "lo"), (end, f"v{part}0"), (middle, f"v{part}1")):
            self.within(space, "ip", "link", "set", device, "up")
        self.within(end, "ip", "route", "add", "default", "via", router)
        # A token bucket; netem, which could delay too, is not in every kernel.
        self.within(middle, "tc", "qdisc", "add", "dev", f"v{part}1", "root", "tbf", "rate", f"{mbit}mbit",
                    "burst", "256kb", "latency", "50ms")

    def within(self, space, *command):
        return run("ip", "netns", "exec", space, *command)

    def open(self, is_open):
        self.within(f"{self.name}-r", "sysctl", "-qw", f"net.ipv4.ip_forward={int(is_open)}")

    def close(self):
        for space in self.spaces():
            subprocess.run(["ip", "netns", "del", space], capture_output=True)


class Sampler(threading.Thread):
    """When the station received how many bytes, a hundred times a second."""

    def __init__(self, network):
        super().__init__(daemon=True)
        self.network, self.samples, self.ended = network, [], False
        self.counter = subprocess.Popen(
            ["ip", "netns", "exec", f"{network.name}-s", sys.executable, "-u", "-c",
             "import time\nwhile True:\n line = [l for l in open('/proc/net/dev') if 'vs0:' in l][0]\n"
             " print(time.time(), line.split(':')[1].split()[0]); time.sleep(0.01)"],
            stdout=subprocess.PIPE, text=True)
        self.start()

    def run(self):
        for line in self.counter.stdout:
            moment, count = line.split()
            self.samples.append((float(moment), int(count)))

    def stop(self):
        self.counter.kill()
        self.join()

    def at(self, moment):
        """Bytes that had been received by then, between the samples beside it."""
        before = max((sample for sample in self.samples if sample[0] <= moment), default=(moment, 0))
        after = min((sample for sample in self.samples if sample[0] > moment), default=before)
        if after[0] == before[0]:
            return before[1]
        return before[1] + (after[1] - before[1]) * (moment - before[0]) / (after[0] - before[0])

    def wait_for(self, mbyte, deadline):
        """Until so much has been received; without an amount until the deadline."""
        while time.time() < deadline and (mbyte is None or not self.samples or self.samples[-1][1] < 1e6 * mbyte):
            time.sleep(0.005)

    def look(self, begin, end):
        """Bytes in the window, and after how long the first five thousand were there."""
        before = self.at(begin)
        count = self.at(end) - before
        first = next((s[0] - begin for s in self.samples if begin <= s[0] <= end and s[1] - before > 5000), None)
        return count, first and round(first, 3)


class CoreWatch(threading.Thread):
    """How long a program's threads computed, and how long they were ready and got no core: the kernel's own count."""

    def __init__(self, pid):
        super().__init__(daemon=True)
        self.tasks, self.times, self.ended = pathlib.Path(f"/proc/{pid}/task"), {}, False
        self.start()

    def run(self):
        while not self.ended:
            try:
                for task in self.tasks.iterdir():
                    ran, waited, _ = (task / "schedstat").read_text().split()
                    self.times[task.name] = (int(ran) * 1e-9, int(waited) * 1e-9)
            except OSError:
                pass  # a thread that ended meanwhile
            time.sleep(0.25)

    def seconds(self):
        """Of all threads together, and of the one that waited longest."""
        self.ended = True
        ran, waited = (sum(column) for column in zip(*self.times.values()))
        return {"cpu_s": round(ran, 1), "waited_s": round(waited, 1),
                "longest_wait_of_a_thread_s": round(max(wait for _, wait in self.times.values()), 1)}


SENDER = """
import socket, sys, time
sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
end = time.time() + float(sys.argv[2])
while time.time() < end:
    try:
        sender.sendto(bytes(1400), (sys.argv[1], 9))
    except OSError:
        pass
"""


def control(network, sampler, window_s):
    """Bytes that a window of this length lets through: a sender that never waits for anybody."""
    network.open(False)
    with subprocess.Popen(["ip", "netns", "exec", f"{network.name}-h", sys.executable, "-c", SENDER, STATION,
                           str(window_s + 1.0)]) as sender:
        time.sleep(0.5)
        begin = time.time()
        network.open(True)
        time.sleep(window_s)
        end = time.time()
        network.open(False)
        sender.wait()
    time.sleep(0.1)
    return sampler.look(begin, end)[0] / (end - begin)


def station_command(arguments):
    """A scan that the head kept is brought, or a room is scanned, with the 12 images of the paper's sweep."""
    if arguments.fetch:
        return ["fetch"]
    return ["scan", "--from", "-30", "--to", "80", "--images", ",".join(str(angle) for angle in range(-30, 81, 10))]


def one_run(arguments, seed, folder):
    rng = random.Random(seed)
    network = Network(f"fsl{os.getpid() % 1000}", arguments.mbit)
    processes = []
    try:
        if arguments.fetch:
            (folder / "head-scans").mkdir()
            shutil.copy(arguments.fetch, folder / "head-scans" / "kept.foresight")
        head_log = open(folder / "head.log", "w")
        head = subprocess.Popen(
            ["ip", "netns", "exec", f"{network.name}-h", arguments.bin / "foresight-head", "--emulate", arguments.scene,
             "--seed", str(seed), "--listen", f"{HEAD}:{PORT}", "--link-keys", arguments.keys / "ca/machines/trial",
             "--scans", folder / "head-scans"], stdout=head_log, stderr=head_log)
        processes.append(head)
        deadline = time.time() + 20
        while "listening" not in (folder / "head.log").read_text() and time.time() < deadline:
            time.sleep(0.05)
        sampler = Sampler(network)
        environment = dict(os.environ, XDG_STATE_HOME=str(folder / "state"))
        began = time.time()
        station = subprocess.Popen(
            ["ip", "netns", "exec", f"{network.name}-s", arguments.bin / "foresightctl", *station_command(arguments),
             "--head", HEAD, "--link-keys", arguments.keys / "ca/machines/anna", "--out", folder / "station.foresight",
             "--json"],
            stdout=open(folder / "station.json", "w"), stderr=open(folder / "station.log", "w"), env=environment)
        processes.append(station)
        watches = {"head": CoreWatch(head.pid), "station": CoreWatch(station.pid)}
        # The first window lasts until the sweep has begun; then the blackouts.
        sampler.wait_for(arguments.first_mbyte, began + arguments.first_s)
        windows = []
        while station.poll() is None and time.time() - began < arguments.limit_s:
            network.open(False)
            time.sleep(rng.uniform(arguments.shortest_s, arguments.longest_s))
            begin = time.time()
            network.open(True)
            while time.time() - begin < arguments.window_s and station.poll() is None:
                time.sleep(0.01)
            end = time.time()
            more = station.poll() is None
            windows.append((begin, end, more))
            if more:
                network.open(False)
        seconds = time.time() - began
        network.open(True)
        code = station.wait(timeout=60) if station.poll() is not None else None
        if code is None:
            station.send_signal(signal.SIGINT)
            station.wait(timeout=30)
        received = sampler.samples[-1][1]
        through = control(network, sampler, arguments.window_s)
        sampler.stop()
        looks = [(b - a, *sampler.look(a, b)) for a, b, more in windows
                 if more and received - sampler.at(a) > through * (b - a)]
        used, resumed = [round(count / (length * through), 3) for length, count, _ in looks], [look[2] for look in looks]
        digests = []
        for mission in [folder / "station.foresight", *sorted((folder / "head-scans").glob("*.foresight"))]:
            shown = subprocess.run([arguments.bin / "foresightctl", "mission", "digest", mission, "--json"],
                                   capture_output=True, text=True)
            digests += [scan["digest"] for scan in json.loads(shown.stdout or "{}").get("scans", [])]
        return {"seed": seed, "exit": code, "seconds": round(seconds, 1), "windows": len(windows), "used": used, "resumed_s": resumed,
                "control_mbyte_per_s": round(through / 1e6, 2),
                "identical": len(digests) == 2 and digests[0] == digests[1],
                "cores": {name: watch.seconds() for name, watch in watches.items()}}
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
    parser.add_argument("--mbit", type=float, default=300.0, help="of the open window")
    parser.add_argument("--fetch", type=pathlib.Path, help="mission with one scan, which the head has kept and the station "
                        "brings, in place of scanning: one of 100 images and more fills several windows")
    parser.add_argument("--window-s", type=float, default=1.0)
    parser.add_argument("--shortest-s", type=float, default=1.0, help="blackout")
    parser.add_argument("--longest-s", type=float, default=30.0, help="blackout")
    parser.add_argument("--first-s", type=float, default=6.0, help="until the first blackout")
    parser.add_argument("--first-mbyte", type=float,
                        help="the first blackout begins when so much has come: a head takes seconds to read a scan of "
                             "a hundred images that it has kept, and until then there is nothing to send")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for logs and missions (default: a temporary one)")
    parser.add_argument("--limit-s", type=float, default=240.0)
    arguments = parser.parse_args()
    arguments.bin = arguments.bin.resolve()
    arguments.scene = arguments.scene.resolve()
    if os.geteuid() != 0 or not shutil.which("ip"):
        print("blackout_trial: needs root and iproute2 for network namespaces", file=sys.stderr)
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
    used = [ratio for outcome in outcomes for ratio in outcome["used"]]
    print(f"{whole} of {len(outcomes)} scans identical; {sum(r >= 0.9 for r in used)} of {len(used)} windows used to "
          f"90 %, least {min(used, default=1.0):.2f}")
    return 0 if whole == len(outcomes) and all(ratio >= 0.9 for ratio in used) else 1


def make_link_keys(arguments):
    """A CA, a head's keys and an operator's, as the user guide makes them."""
    ctl = arguments.bin / "foresightctl"
    ca = arguments.keys / "ca"
    run(ctl, "pki", "init", "--pki", ca)
    run(ctl, "pki", "head", "trial", "--address", HEAD, "--pki", ca)
    run(ctl, "pki", "operator", "anna", "--pki", ca)


if __name__ == "__main__":
    sys.exit(main())
