#!/usr/bin/python3
"""Attacks a running head as strangers would, with tools that know nothing of ours (openssl, gRPC for Python), while an
operator's session goes on.

    tests/link/security_trial.py --bin build/release/bin --scene resources/scenes/room.yaml --seed 1

Required of each attack: it is refused, the head's state and scans are as before, and the operator's calls are answered
within --patience-s meanwhile. Needs protoc, python3-grpcio, python3-protobuf and openssl. Exit 0 when all holds; one
line of JSON an attack.
"""
import argparse
import json
import os
import pathlib
import random
import shutil
import socket
import ssl
import subprocess
import sys
import tempfile
import threading
import time

try:
    import grpc
except ImportError:
    print("security_trial: python3-grpcio is not there", file=sys.stderr)
    sys.exit(77)

# At most so many open files: what a service of a usual Linux gets.
OPEN_FILES = 1024


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True)


def read(path):
    return pathlib.Path(path).read_bytes()


class Head:
    """The program, with keys of a CA of its own."""

    def __init__(self, arguments, folder):
        self.folder, self.ca = folder, folder / "ca"
        ctl = arguments.bin / "foresightctl"
        run(ctl, "pki", "init", "--pki", self.ca)
        run(ctl, "pki", "head", "trial", "--address", "127.0.0.1", "--pki", self.ca)
        run(ctl, "pki", "operator", "anna", "--pki", self.ca)
        run(ctl, "pki", "observer", "otto", "--pki", self.ca)
        self.log = folder / "head.log"
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.program = subprocess.Popen(
            ["prlimit", f"--nofile={OPEN_FILES}", arguments.bin / "foresight-head", "--emulate", arguments.scene, "--seed",
             str(arguments.seed), "--listen", f"127.0.0.1:{self.port}", "--link-keys", self.keys("trial"), "--no-announce",
             "--scans", folder / "scans"], stdout=open(self.log, "w"), stderr=subprocess.STDOUT)
        deadline = time.time() + 20
        while "listening" not in self.log.read_text() and time.time() < deadline:
            time.sleep(0.05)

    def keys(self, name):
        return self.ca / "machines" / name

    def channel(self, keys):
        folder = keys if isinstance(keys, pathlib.Path) else self.keys(keys)
        credentials = grpc.ssl_channel_credentials(read(self.keys("trial") / "ca.crt"), read(folder / "link.key"),
                                                   read(folder / "link.crt"))
        return grpc.secure_channel(f"127.0.0.1:{self.port}", credentials,
                                   options=[("grpc.use_local_subchannel_pool", 1), ("grpc.max_send_message_length", -1)])

    def memory_mb(self):
        status = pathlib.Path(f"/proc/{self.program.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0]) / 1024

    def stop(self):
        self.program.terminate()
        return self.program.wait(timeout=30)


class Caller:
    """Calls of one peer, by the published description of the service alone."""

    def __init__(self, messages, channel):
        self.messages, self.channel = messages, channel
        service = messages.DESCRIPTOR.services_by_name["SensorHead"]
        self.methods = {method.name: method for method in service.methods}
        self.version = [("foresight-protocol", str(self.call("Identify", messages.IdentifyRequest(protocol=1)).protocol))]

    def call(self, name, request, timeout=5.0, raw=None):
        """`raw`: these bytes in place of the request."""
        method = self.methods[name]
        reply = getattr(self.messages, method.output_type.name)
        make = {(False, False): self.channel.unary_unary, (False, True): self.channel.unary_stream,
                (True, False): self.channel.stream_unary, (True, True): self.channel.stream_stream}
        inward = name in ("Watch", "Transfer")
        outward = name in ("Watch", "Transfer", "Look", "FetchStops")
        stub = make[inward, outward]("/foresight.link.SensorHead/" + name,
                                     request_serializer=lambda sent: sent if raw is not None else sent.SerializeToString(),
                                     response_deserializer=reply.FromString)
        sent = request if raw is None else raw
        metadata = getattr(self, "version", None)
        answer = stub(iter([sent]) if inward else sent, timeout=timeout, metadata=metadata)
        return next(iter(answer), None) if outward else answer

    def code(self, name, request, **kwargs):
        try:
            self.call(name, request, **kwargs)
            return "OK"
        except grpc.RpcError as error:
            return error.code().name

    def request(self, name):
        return getattr(self.messages, self.methods[name].input_type.name)

    def state(self):
        """What no attack may change."""
        status = self.call("Watch", self.messages.SignOfLife(number=1)).status
        scans = self.call("ListScans", self.messages.ListScansRequest()).scans
        return status.state, status.scan_id, status.rig_id, sorted((scan.scan_id, scan.digest) for scan in scans)


class Session(threading.Thread):
    """An operator at work: a question five times a second on a connection that was there before."""

    def __init__(self, caller):
        super().__init__(daemon=True)
        self.caller, self.longest, self.failed, self.ended = caller, 0.0, [], False
        self.start()

    def run(self):
        while not self.ended:
            began = time.time()
            code = self.caller.code("ListScans", self.caller.messages.ListScansRequest(), timeout=10)
            self.longest = max(self.longest, time.time() - began)
            if code != "OK":
                self.failed.append(code)
            time.sleep(0.2)

    def look(self):
        longest, failed = self.longest, self.failed
        self.longest, self.failed = 0.0, []
        return round(longest, 3), failed


# Attacks. Each takes what the trial has and returns a list of faults, and what it saw.

def port_scan(trial):
    """What speaks no TLS, or has no certificate, hears a TLS alert or nothing.

    A client of TLS sees the head's certificate, with its name and its addresses: that is told, and no fault."""
    heard, faults = {}, []
    greetings = {"nothing": b"", "HTTP": b"GET / HTTP/1.1\r\nHost: head\r\n\r\n", "HTTP/2": b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
                 "SSH": b"SSH-2.0-scan\r\n", "zeros": bytes(64), "noise": random.Random(1).randbytes(512)}
    for name, bytes_sent in greetings.items():
        with socket.create_connection(("127.0.0.1", trial.head.port), timeout=3) as peer:
            answer = b""
            try:
                peer.sendall(bytes_sent)
                if bytes_sent:
                    peer.shutdown(socket.SHUT_WR)
                answer = peer.recv(4096)
            except (TimeoutError, ConnectionError):
                pass
        heard[name] = answer.hex()
        if answer and answer[0] != 0x15:
            faults.append(f"{name}: answered {answer[:40]!r}")
    shown = subprocess.run(["openssl", "s_client", "-connect", f"127.0.0.1:{trial.head.port}", "-alpn", "h2"],
                           input="", capture_output=True, text=True, timeout=20)
    # A TLS server shows its certificate before it asks for one.
    subject = [line.strip() for line in shown.stdout.splitlines() if line.startswith("subject=")]
    return faults, {"heard": heard, "certificate": subject}


def no_certificate(trial):
    credentials = grpc.ssl_channel_credentials(read(trial.head.keys("trial") / "ca.crt"))
    channel = grpc.secure_channel(f"127.0.0.1:{trial.head.port}", credentials)
    code = raw_code(channel, trial)
    return [] if code == "UNAVAILABLE" else [f"Identify: {code}"], {"code": code}


def foreign_ca(trial):
    other = trial.folder / "other"
    run(trial.arguments.bin / "foresightctl", "pki", "init", "--pki", other)
    run(trial.arguments.bin / "foresightctl", "pki", "operator", "anna", "--pki", other)
    code = raw_code(trial.head.channel(other / "machines/anna"), trial)
    return [] if code == "UNAVAILABLE" else [f"Identify: {code}"], {"code": code}


def head_as_operator(trial):
    code = raw_code(trial.head.channel("trial"), trial)
    return [] if code == "UNAVAILABLE" else [f"Identify: {code}"], {"code": code}


def signed_by_openssl(trial, name, days):
    """A folder with an operator's keys and a certificate of the head's own CA for so many days, made by openssl."""
    run(trial.arguments.bin / "foresightctl", "pki", "operator", name, "--pki", trial.head.ca)
    folder = trial.head.keys(name)
    certificate, request = folder / "link.crt", folder / "request"
    run("openssl", "x509", "-x509toreq", "-in", certificate, "-signkey", folder / "link.key", "-copy_extensions", "copyall",
        "-out", request)
    run("openssl", "x509", "-req", "-in", request, "-CA", trial.head.ca / "ca.crt", "-CAkey", trial.head.ca / "ca.key",
        "-days", str(days), "-copy_extensions", "copyall", "-out", certificate)
    return folder


def expired(trial):
    """Yesterday's certificate; one made the same way for today is let in, so the date alone is refused."""
    today = raw_code(trial.head.channel(signed_by_openssl(trial, "today", 1)), trial)
    yesterday = raw_code(trial.head.channel(signed_by_openssl(trial, "yesterday", -1)), trial)
    faults = [] if today == "OK" else [f"one that is good today: {today}"]
    if yesterday != "UNAVAILABLE":
        faults.append(f"one that ended yesterday: {yesterday}")
    return faults, {"today": today, "yesterday": yesterday}


def revoked(trial):
    """While the head runs: the connection that is open, and a new one."""
    ctl = trial.arguments.bin / "foresightctl"
    run(ctl, "pki", "operator", "mallory", "--pki", trial.head.ca)
    stolen = trial.folder / "stolen"
    shutil.copytree(trial.head.keys("mallory"), stolen)
    mallory = Caller(trial.messages, trial.head.channel(stolen))
    before = mallory.code("ListScans", trial.messages.ListScansRequest())
    run(ctl, "pki", "revoke", "mallory", "--pki", trial.head.ca)
    shutil.copy(trial.head.ca / "ca.crl", trial.head.keys("trial") / "ca.crl")
    same = mallory.code("ListScans", trial.messages.ListScansRequest())
    anew = raw_code(trial.head.channel(stolen), trial)
    faults = [f"{what}: {code}" for what, code, right in
              (("before", before, "OK"), ("the open connection", same, "UNAUTHENTICATED"), ("a new one", anew, "UNAVAILABLE"))
              if code != right]
    return faults, {"before": before, "open_connection": same, "new_connection": anew}


def raw_code(channel, trial):
    call = channel.unary_unary("/foresight.link.SensorHead/Identify", request_serializer=bytes)
    try:
        call(trial.messages.IdentifyRequest(protocol=1).SerializeToString(), timeout=5)
        return "OK"
    except grpc.RpcError as error:
        return error.code().name
    finally:
        channel.close()


def observer_acts(trial):
    """Everything that acts, with an observer's certificate."""
    faults, seen = [], {}
    messages, observer = trial.messages, trial.observer
    control = observer.call("TakeControl", messages.ControlRequest())
    if control.granted:
        faults.append("an observer has control")
    seen["TakeControl"] = control.reason
    home = messages.Command(command_id="c0ffee00-0000-4000-8000-000000000001", home=messages.Home())
    fit = messages.FitRequest(command_id="c0ffee00-0000-4000-8000-000000000002")
    refused = {"Execute": (home, lambda reply: reply.error), "Stop": (messages.StopRequest(), lambda reply: reply.error),
               "PublishPose": (messages.PoseRequest(), lambda reply: reply.answer != "accepted"),
               "OpenBurst": (messages.BurstRequest(port=9), lambda reply: False),
               "Fit": (fit, lambda reply: reply.HasField("failure"))}
    for name, (request, is_refused) in refused.items():
        try:
            reply = observer.call(name, request)
            seen[name] = str(reply)[:120]
            if not is_refused(reply):
                faults.append(f"{name} was carried out")
        except grpc.RpcError as error:
            seen[name] = f"{error.code().name}: {error.details()}"
    return faults, seen


def replay(trial):
    """One command twice, then late, then without the lease and with another's."""
    messages, anna = trial.messages, trial.operator
    control = anna.call("TakeControl", messages.ControlRequest())
    identity = anna.call("Identify", messages.IdentifyRequest(protocol=int(anna.version[0][1])))
    command = messages.Command(command_id="c0ffee00-0000-4000-8000-000000000003", control_token=control.token,
                               boot_id=identity.boot_id, void_after_s=identity.desk_time_s + 30)
    command.end_scan.scan_id = "none"
    first, again = anna.call("Execute", command), anna.call("Execute", command)
    faults = [] if again.repeated and not first.repeated else ["a repeat was carried out"]
    late = messages.Command()
    late.CopyFrom(command)
    late.command_id, late.void_after_s = "c0ffee00-0000-4000-8000-000000000004", 0.001
    forged = messages.Command()
    forged.CopyFrom(command)
    forged.command_id, forged.control_token = "c0ffee00-0000-4000-8000-000000000005", b"\0" * len(control.token)
    forged.home.SetInParent()
    seen = {}
    for name, message in (("late", late), ("forged lease", forged)):
        outcome = anna.call("Execute", message)
        seen[name] = outcome.message
        if not outcome.error:
            faults.append(f"{name}: carried out")
    anna.call("ReleaseControl", messages.ReleaseRequest(token=control.token))
    return faults, seen


def oversized(trial):
    codes = {size: trial.operator.code("PublishPose", None, raw=b"\x0a" + varint(size) + bytes(size), timeout=20)
             for size in (17 << 20, 64 << 20)}
    return [f"{size} bytes: {code}" for size, code in codes.items() if code != "RESOURCE_EXHAUSTED"], codes


def varint(value):
    out = b""
    while value > 127:
        out += bytes([value & 127 | 128])
        value >>= 7
    return out + bytes([value])


def fuzzed(trial):
    """Random bytes, and requests with flipped bytes, to every method with both roles."""
    rng = random.Random(trial.arguments.seed)
    codes, calls = {}, 0
    end = time.time() + trial.arguments.fuzz_s
    names = list(trial.operator.methods)
    while time.time() < end:
        name = rng.choice(names)
        caller = rng.choice([trial.operator, trial.observer])
        if name == "Stop":
            caller = trial.observer  # an operator's stop is no attack
        code = caller.code(name, None, raw=hostile(rng, caller.request(name)), timeout=0.5)
        calls += 1
        codes[code] = codes.get(code, 0) + 1
    faults = ["the head's program ended"] if trial.head.program.poll() is not None else []
    return faults, {"calls": calls, "codes": codes}


def hostile(rng, kind):
    if rng.random() < 0.3:
        return rng.randbytes(rng.choice([0, 1, 7, 64, 1000, 60_000]))
    message = kind()
    for field in kind.DESCRIPTOR.fields:
        if rng.random() < 0.4 or field.message_type:
            continue
        values = {field.CPPTYPE_STRING: [b"\xff\xfe" * 9 if field.type == field.TYPE_BYTES else "../../etc/passwd",
                                         b"" if field.type == field.TYPE_BYTES else "\0" * 99],
                  field.CPPTYPE_DOUBLE: [float("nan"), float("inf"), -1e308], field.CPPTYPE_BOOL: [True],
                  field.CPPTYPE_INT32: [-2**31, 2**31 - 1], field.CPPTYPE_INT64: [-2**63, 2**63 - 1],
                  field.CPPTYPE_UINT32: [2**32 - 1], field.CPPTYPE_ENUM: [99, -1]}.get(field.cpp_type, [])
        value = rng.choice(values) if values else None
        if value is None:
            continue
        if field.label == field.LABEL_REPEATED:
            getattr(message, field.name).extend([value] * 50)
        else:
            setattr(message, field.name, value)
    sent = bytearray(message.SerializeToString())
    for _ in range(rng.choice([0, 0, 1, 4]) if sent else 0):
        sent[rng.randrange(len(sent))] ^= 1 << rng.randrange(8)
    return bytes(sent)


def slow_loris(trial):
    """Two hundred connections that say a byte of a TLS greeting a second."""
    greeting = client_hello()
    peers = []
    for _ in range(200):
        peers.append(socket.create_connection(("127.0.0.1", trial.head.port), timeout=3))
    for at in range(trial.arguments.loris_s):
        for peer in peers:
            try:
                peer.send(greeting[at:at + 1])
            except OSError:
                pass
        time.sleep(1.0)
    newcomer = trial.newcomer()
    for peer in peers:
        peer.close()
    return ([] if newcomer < trial.arguments.patience_s else [f"a new operator waits {newcomer:.1f} s"],
            {"newcomer_s": round(newcomer, 3)})


def client_hello():
    incoming, outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    try:
        context.wrap_bio(incoming, outgoing).do_handshake()
    except ssl.SSLWantReadError:
        pass
    return outgoing.read()


def thousand_connections(trial):
    """Which stay open and say nothing: more than a usual program may have files open."""
    peers = []
    for _ in range(1000):
        try:
            peers.append(socket.create_connection(("127.0.0.1", trial.head.port), timeout=3))
        except OSError:
            break
    newcomer = trial.newcomer()
    stopped = trial.operator.code("Stop", trial.messages.StopRequest())
    open_files = len(os.listdir(f"/proc/{trial.head.program.pid}/fd"))
    for peer in peers:
        peer.close()
    faults = [] if newcomer < trial.arguments.patience_s else [f"a new operator waits {newcomer:.1f} s"]
    if stopped != "OK":
        faults.append(f"the operator's stop: {stopped}")
    return faults, {"connections": len(peers), "open_files": open_files, "newcomer_s": round(newcomer, 3)}


ATTACKS = [port_scan, no_certificate, foreign_ca, expired, revoked, head_as_operator, observer_acts, replay, oversized, fuzzed, slow_loris,
           thousand_connections]


class Trial:
    def __init__(self, arguments, folder, messages):
        self.arguments, self.folder, self.messages = arguments, folder, messages
        self.head = Head(arguments, folder)
        self.operator = Caller(messages, self.head.channel("anna"))
        self.observer = Caller(messages, self.head.channel("otto"))

    def newcomer(self):
        """Seconds until an operator who comes now is answered."""
        began = time.time()
        limit_s = self.arguments.patience_s + 5
        while time.time() - began < limit_s:
            channel = self.head.channel("anna")
            if raw_code(channel, self) == "OK":
                break
        return time.time() - began

    def run(self):
        bad = 0
        session = Session(self.operator)
        for attack in ATTACKS:
            before = self.operator.state()
            session.look()
            began = time.time()
            faults, seen = attack(self)
            longest, failed = session.look()
            if self.operator.state() != before:
                faults.append("the head's state changed")
            if failed or longest > self.arguments.patience_s:
                faults.append(f"the operator's session: {longest} s, {failed}")
            print(json.dumps({"attack": attack.__name__, "faults": faults, "seconds": round(time.time() - began, 1),
                              "operators_longest_call_s": longest, "head_memory_mb": round(self.head.memory_mb()),
                              "seen": seen}), flush=True)
            bad += bool(faults)
        session.ended = True
        session.join()
        return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path("build/release/bin"))
    parser.add_argument("--scene", type=pathlib.Path, default=pathlib.Path("resources/scenes/room.yaml"))
    parser.add_argument("--proto", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parents[2] / "hardware/link/sensor_head.proto")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--fuzz-s", type=float, default=5.0)
    parser.add_argument("--loris-s", type=int, default=5)
    parser.add_argument("--patience-s", type=float, default=2.0)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for logs and keys (default: a temporary one)")
    arguments = parser.parse_args()
    arguments.bin, arguments.scene = arguments.bin.resolve(), arguments.scene.resolve()
    for tool in ("protoc", "openssl", "prlimit"):
        if not shutil.which(tool):
            print(f"security_trial: {tool} is not there", file=sys.stderr)
            return 77
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        run("protoc", f"--proto_path={arguments.proto.parent}", f"--python_out={folder}", arguments.proto)
        sys.path.insert(0, str(folder))
        import sensor_head_pb2 as messages
        trial = Trial(arguments, folder, messages)
        try:
            bad = trial.run()
            code = trial.head.stop()
            if code != 0:
                print(f"the head ended with {code}", file=sys.stderr)
                bad += 1
        finally:
            trial.head.program.kill()
    print(f"{len(ATTACKS) - bad} of {len(ATTACKS)} attacks were refused and changed nothing")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
