#!/usr/bin/env python3
"""Reads a Foresight mission with nothing but Python: read_mission.py FILE prints what each scan holds (docs/formats.md)."""
import itertools, sqlite3, struct, sys, zlib

def channels(beams, data):  # ranges in millimetres (below 23: a status code), then intensities where there are any; codec 1
    planes = zlib.decompress(data)
    for at in range(0, len(planes), 2 * beams):
        codes = (low | high << 8 for low, high in zip(planes[at:at + beams], planes[at + beams:at + 2 * beams]))
        yield list(itertools.accumulate(codes, lambda last, code: (last + (code >> 1 ^ -(code & 1))) & 0xFFFF, initial=0))[1:]

mission = sqlite3.connect(f"file:{sys.argv[1]}?mode=ro", uri=True)
for scan, uuid, state in mission.execute("SELECT id, uuid, state FROM scan ORDER BY id"):
    print("scan", scan, uuid, state)
    for (batch,) in mission.execute("SELECT data FROM motor WHERE scan_id = ? ORDER BY batch", [scan]):
        print("motor", *struct.unpack("<2d", batch[:16]))
    for seq, time_s, beams, data in mission.execute("SELECT seq, time_s, beams, data FROM line WHERE scan_id = ? ORDER BY seq", [scan]):
        print("line", seq, time_s, *([sum(values) for values in channels(beams, data)] + [0])[:2])
    given = mission.execute("SELECT 1 FROM sqlite_schema WHERE name = 'given_line'").fetchone()  # from format 3 on
    for line, beams, data in given and mission.execute("SELECT line, beams, data FROM given_line WHERE scan_id = ? ORDER BY line", [scan]) or []:
        print("given", line, sum(x == x for x in struct.unpack_from(f"<{beams}f", zlib.decompress(data), 12)))
