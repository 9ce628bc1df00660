"""Reads a .palpate by docs/notes/palpate_format.md alone: sqlite3, struct and zlib, nothing of palpate.

    independent_reader.py FILE OUT

Checks every promise of the format (AssertionError otherwise) and writes all samples to OUT: for each
stream the number of items as i64, then per item host time [us] and device time [us] as i64 and the
values, f32 for frames, f64 for the others; everything little-endian.
"""
import sqlite3
import struct
import sys
import zlib

NO_DEVICE_TIME = -2**63


def row_crc(*values):
    crc = 0
    for value in values:
        if value is None:
            continue
        if isinstance(value, int):
            crc = zlib.crc32(struct.pack("<q", value), crc)
        elif isinstance(value, float):
            crc = zlib.crc32(struct.pack("<d", value), crc)
        else:
            data = value if isinstance(value, bytes) else value.encode()
            crc = zlib.crc32(data, zlib.crc32(struct.pack("<q", len(data)), crc))
    return crc


def block_crc(stream, first, n, t0_us, t1_us, coding, data):
    return zlib.crc32(data, zlib.crc32(struct.pack("<6q", stream, first, n, t0_us, t1_us, coding)))


def values_of(coding, data, at, width):
    """Values of the item at `at`, those of them that count as contact, and where the next one begins."""
    values = []
    if coding == 0:
        while len(values) < width:
            (unit,) = struct.unpack_from("<H", data, at)
            values += [float(unit & 0xFFF)] * (unit >> 12)
            at += 2
    elif coding in (1, 4):
        if coding == 4:
            counting = [data[at + i // 8] >> i % 8 & 1 for i in range(width)]
            at += (width + 7) // 8
            assert not any(data[at - 1] >> i & 1 for i in range(width % 8 or 8, 8))
        while len(values) < width:
            run, value = struct.unpack_from("<Bf", data, at)
            values += [value] * run
            at += 5
    else:
        letter = "f" if coding == 2 else "d"
        values = list(struct.unpack_from(f"<{width}{letter}", data, at))
        at += struct.calcsize(f"<{width}{letter}")
    assert len(values) == width
    return values, [v if c else 0.0 for v, c in zip(values, counting)] if coding == 4 else values, at


def read(path):
    db = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    one = lambda sql: db.execute(sql).fetchone()[0]
    assert one("PRAGMA application_id") == 0x50414C50
    version = 2 if one("SELECT EXISTS(SELECT 1 FROM block WHERE coding & 8)") else 1
    assert one("PRAGMA user_version") == version
    assert one("PRAGMA page_size") == 4096
    assert one("PRAGMA integrity_check") == "ok"
    columns = lambda table: [row[1] for row in db.execute(f"PRAGMA table_info({table})")]
    assert columns("meta") == ["key", "value", "crc32"]
    assert columns("matrix") == ["idx", "rows", "columns", "pitch_mm", "static_mask",
                                 "dynamic_mask", "uid", "crc32"]
    assert columns("block") == ["id", "stream", "first", "n", "t0_us", "t1_us", "coding", "crc32",
                                "data"]
    assert columns("second") == ["t_s", "matrix", "frames", "min", "max", "sum", "active_max",
                                 "crc32"]
    assert columns("event") == ["id", "t_us", "t1_us", "kind", "matrix", "text", "json", "crc32"]
    assert columns("counter") == ["name", "value"]
    assert [row[2] for row in db.execute("PRAGMA index_info(block_at)")] == [
        "stream", "first", "n", "t0_us", "t1_us"]
    for table in ("meta", "matrix", "second", "event"):
        for *values, crc in db.execute(f"SELECT * FROM {table}"):
            assert crc == row_crc(*values), (table, values)

    shapes = db.execute("SELECT rows, columns FROM matrix ORDER BY idx").fetchall()
    places = sum(rows * columns for rows, columns in shapes)
    streams = []
    for stream in range(3):
        items = []
        width = places if stream == 0 else None
        for first, n, t0, t1, coding, crc, data in db.execute(
                "SELECT first, n, t0_us, t1_us, coding, crc32, data FROM block WHERE stream=?"
                " ORDER BY first", (stream,)):
            assert crc == block_crc(stream, first, n, t0, t1, coding, data)
            in_us, coding = coding & 8, coding & 7
            assert len(data) <= 4000 or n == 1
            assert first == len(items)
            if width is None:
                width = (len(data) // n - 12) // (8 if coding == 3 else 4)
            at = 0
            for i in range(n):
                offset, device = struct.unpack_from("<Iq", data, at)
                if device != NO_DEVICE_TIME and not in_us:
                    device *= 1000
                values, contact, at = values_of(coding, data, at + 12, width)
                items.append((t0 + offset, device, values, contact))
            assert at == len(data)
            assert items[first][0] == t0 and items[-1][0] == t1
        assert all(a[0] < b[0] for a, b in zip(items, items[1:]))
        streams.append(items)

    # The summary, from the frames.
    seconds = {}
    for t_us, _, _, values in streams[0]:
        begin = 0
        for m, (rows, columns) in enumerate(shapes):
            active = [v for v in values[begin:begin + rows * columns] if v > 0]
            begin += rows * columns
            row = seconds.setdefault((t_us // 1_000_000, m), [0, [], 0])
            row[0] += 1
            row[1] += active
            row[2] = max(row[2], len(active))
    stored = {(t, m): rest for t, m, *rest in db.execute(
        "SELECT t_s, matrix, frames, min, max, sum, active_max FROM second")}
    assert stored.keys() == seconds.keys()
    for key, (frames, active, most) in seconds.items():
        n, low, high, total, active_max = stored[key]
        assert (n, active_max) == (frames, most), key
        assert (low, high) == (min(active, default=0), max(active, default=0)), key
        assert abs(total - sum(active)) <= 1e-9 * max(1.0, abs(total)), key
    return [[item[:3] for item in items] for items in streams]


def dump(streams, path):
    with open(path, "wb") as out:
        for stream, items in enumerate(streams):
            out.write(struct.pack("<q", len(items)))
            for t_us, device, values in items:
                letter = "f" if stream == 0 else "d"
                out.write(struct.pack(f"<qq{len(values)}{letter}", t_us, device, *values))


if __name__ == "__main__":
    dump(read(sys.argv[1]), sys.argv[2])
