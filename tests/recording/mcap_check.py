"""An independent reader of MCAP files (mcap.dev/spec) with the standard library alone: files without compression.

read() checks every rule of the specification that Palpate's files keep: checksums, indexes, statistics, the summary and
its offsets. Writer makes files as other programs do.
"""

import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"


class Cursor:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, count):
        assert self.at + count <= len(self.data), "too short"
        self.at += count
        return self.data[self.at - count : self.at]

    def number(self, form):
        return struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0]

    def text(self):
        return self.take(self.number("I")).decode("utf-8")

    def texts(self):
        part, values = Cursor(self.take(self.number("I"))), {}
        while part.at < len(part.data):
            key = part.text()
            assert key not in values
            values[key] = part.text()
        return values

    def numbers(self, first, second):
        part, values = Cursor(self.take(self.number("I"))), []
        while part.at < len(part.data):
            values.append((part.number(first), part.number(second)))
        return values


class Cdr(Cursor):
    """A message in CDR, little-endian."""

    def __init__(self, data):
        assert data[:4] == b"\0\1\0\0"
        super().__init__(data[4:])

    def number(self, form):
        size = struct.calcsize("<" + form)
        self.take(-self.at % size)
        return super().number(form)

    def text(self):
        data = self.take(self.number("I"))
        assert data[-1:] == b"\0" and b"\0" not in data[:-1]
        return data[:-1].decode("utf-8")

    def doubles(self):
        return [self.number("d") for _ in range(self.number("I"))]

    def stamp_ns(self):
        seconds = self.number("i")
        return seconds * 10**9 + self.number("I")

    def end(self):
        assert self.at == len(self.data), "bytes are left"


def image(data):
    """Stamp [ns], frame, encoding and the values by rows of a sensor_msgs/msg/Image."""
    cdr = Cdr(data)
    stamp, frame = cdr.stamp_ns(), cdr.text()
    rows, columns, encoding = cdr.number("I"), cdr.number("I"), cdr.text()
    assert cdr.number("B") == 0
    form = {"mono16": "H", "32FC1": "f"}[encoding]
    step = cdr.number("I")
    assert step == columns * struct.calcsize(form)
    pixels = cdr.take(cdr.number("I"))
    cdr.end()
    return stamp, frame, encoding, [list(struct.unpack(f"<{columns}{form}", pixels[r * step : (r + 1) * step])) for r in range(rows)]


def records(data, at, end):
    while at < end:
        opcode, length = struct.unpack_from("<BQ", data, at)
        assert at + 9 + length <= end, "a record is longer than its place"
        yield opcode, at, data[at + 9 : at + 9 + length]
        at += 9 + length


def schema(content):
    c = Cursor(content)
    return c.number("H"), (c.text(), c.text(), bytes(c.take(c.number("I"))))


def channel(content):
    c = Cursor(content)
    return c.number("H"), (c.number("H"), c.text(), c.text(), c.texts())


def read(path):
    """The content of a file: profile, metadata, attachments, and messages by topic (log time, data)."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == MAGIC and data[-8:] == MAGIC
    end = data_end = None
    schemas, channels, metadata, attachments, messages = {}, {}, {}, {}, {}
    chunks, metadata_at, attachments_at, indexes = {}, [], [], {}
    sequence = {}
    times = []
    last_chunk = None
    for opcode, at, content in records(data, 8, len(data) - 8):
        c = Cursor(content)
        if at == 8:
            assert opcode == 1
            profile, library = c.text(), c.text()
        elif opcode == 3:
            number, value = schema(content)
            assert number not in schemas
            schemas[number] = value
        elif opcode == 4:
            number, value = channel(content)
            assert number not in channels and value[0] in schemas
            channels[number] = value
            messages[value[1]] = []
        elif opcode == 6:
            start, stop, size, crc = (c.number(f) for f in "QQQI")
            compression = c.text()
            assert compression == "", "only without compression"
            raw = c.take(c.number("Q"))
            assert c.at == len(content) and len(raw) == size and zlib.crc32(raw) == crc != 0
            inside = {}
            for inner, where, message in records(raw, 0, len(raw)):
                assert inner == 5
                m = Cursor(message)
                number, count, log, publish = (m.number(f) for f in "HIQQ")
                assert publish == log and count == sequence.get(number, 0)
                sequence[number] = count + 1
                inside.setdefault(number, []).append((log, where))
                messages[channels[number][1]].append((log, message[m.at :]))
                times.append(log)
            logs = [log for entries in inside.values() for log, _ in entries]
            assert (start, stop) == (min(logs), max(logs))
            last_chunk = at
            chunks[at] = (start, stop, 9 + len(content), size, inside)
            indexes[at] = {}
        elif opcode == 7:
            number, entries = c.number("H"), c.numbers("Q", "Q")
            assert entries == chunks[last_chunk][4][number]
            indexes[last_chunk][number] = (at, 9 + len(content))
        elif opcode == 9:
            log, created = c.number("Q"), c.number("Q")
            name, media = c.text(), c.text()
            body = c.take(c.number("Q"))
            assert zlib.crc32(content[: c.at]) == c.number("I")
            attachments[name] = body
            attachments_at.append((at, 9 + len(content), log, created, len(body), name, media))
        elif opcode == 12:
            name = c.text()
            metadata[name] = c.texts()
            metadata_at.append((at, 9 + len(content), name))
        elif opcode == 15:
            assert c.number("I") == zlib.crc32(data[:at]) != 0
            data_end = at + 9 + len(content)
            break
        else:
            raise AssertionError(f"record {opcode} in the data section")
    for at, chunk in chunks.items():
        assert indexes[at].keys() == chunk[4].keys()
    # The summary.
    groups, footer = [], None
    chunk_index, attachment_index, metadata_index, offsets = [], [], [], []
    copies = {3: {}, 4: {}}
    for opcode, at, content in records(data, data_end, len(data) - 8):
        c = Cursor(content)
        if opcode not in (2, 14):
            if not groups or groups[-1][0] != opcode:
                assert opcode not in [group[0] for group in groups], "records are not grouped"
                groups.append([opcode, at, 0])
            groups[-1][2] += 9 + len(content)
        if opcode in (3, 4):
            number, value = (schema if opcode == 3 else channel)(content)
            copies[opcode][number] = value
        elif opcode == 8:
            start, stop, where, length = (c.number("Q") for _ in range(4))
            at_index = dict(c.numbers("H", "Q"))
            index_length = c.number("Q")
            assert c.text() == ""
            packed, size = c.number("Q"), c.number("Q")
            assert (start, stop, length, size) == chunks[where][:4] and packed == size
            assert at_index == {number: place[0] for number, place in indexes[where].items()}
            assert index_length == sum(place[1] for place in indexes[where].values())
            chunk_index.append(where)
        elif opcode == 10:
            attachment_index.append((*(c.number("Q") for _ in range(5)), c.text(), c.text()))
        elif opcode == 13:
            metadata_index.append((c.number("Q"), c.number("Q"), c.text()))
        elif opcode == 11:
            counts = [c.number(f) for f in "QHIIIIQQ"]
            expected = [len(times), len(schemas), len(channels), len(attachments), len(metadata_at), len(chunks)]
            assert counts == expected + [min(times, default=0), max(times, default=0)], (counts, expected)
            assert dict(c.numbers("H", "Q")) == {n: len(messages[v[1]]) for n, v in channels.items()}
        elif opcode == 14:
            offsets.append([c.number("B"), c.number("Q"), c.number("Q")])
        elif opcode == 2:
            footer = at
            summary, summary_offsets, crc = c.number("Q"), c.number("Q"), c.number("I")
            assert summary == data_end and crc == zlib.crc32(data[data_end : at + 9 + 16]) != 0
            assert data[summary_offsets] == 14
            assert at + 9 + 20 == len(data) - 8
    assert footer and offsets == groups
    assert copies == {3: schemas, 4: channels}
    assert chunk_index == sorted(chunks) and attachment_index == attachments_at and metadata_index == metadata_at
    types = {v[1]: (schemas[v[0]][0], schemas[v[0]][1], v[2]) for v in channels.values()}
    of_channels = {v[1]: v[3] for v in channels.values()}
    return dict(profile=profile, library=library, metadata=metadata, attachments=attachments, messages=messages,
                types=types, channels=of_channels, chunks=len(chunks))


def record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def text(value):
    data = value.encode()
    return struct.pack("<I", len(data)) + data


def cdr_text(out, value):
    out += b"\0" * (-len(out) % 4)
    return out + struct.pack("<I", len(value) + 1) + value.encode() + b"\0"


def cdr_image(stamp_ns, rows, encoding, big=False, padding=0, frame="camera"):
    """A sensor_msgs/msg/Image of rows of numbers; its rows are `padding` bytes longer than they need be."""
    order, form = ">" if big else "<", {"mono8": "B", "mono16": "H", "16UC1": "H", "32FC1": "f", "rgb8": "B"}[encoding]
    out = struct.pack("<iI", stamp_ns // 10**9, stamp_ns % 10**9)
    out = cdr_text(out, frame)
    out += b"\0" * (-len(out) % 4)
    out += struct.pack("<II", len(rows), len(rows[0]) if rows else 0)
    out = cdr_text(out, encoding) + struct.pack("<B", big)
    pixels = b"".join(struct.pack(f"{order}{len(row)}{form}", *row) + b"\0" * padding for row in rows)
    out += b"\0" * (-len(out) % 4)
    return b"\0\1\0\0" + out + struct.pack("<II", len(pixels) // max(1, len(rows)), len(pixels)) + pixels


def cdr_joints(stamp_ns, names, positions):
    out = struct.pack("<iI", stamp_ns // 10**9, stamp_ns % 10**9)
    out = cdr_text(out, "")
    out += b"\0" * (-len(out) % 4) + struct.pack("<I", len(names))
    for name in names:
        out = cdr_text(out, name)
    out += b"\0" * (-len(out) % 4) + struct.pack("<I", len(positions))
    out += b"\0" * (-len(out) % 8) + struct.pack(f"<{len(positions)}d", *positions)
    return b"\0\1\0\0" + out + struct.pack("<II", 0, 0)


class Writer:
    """Messages outside of chunks, or with `chunk` in chunks of so many, each with its schemas and channels; no summary."""

    def __init__(self, path, chunk=0, compression=""):
        self.file, self.chunk, self.waiting, self.topics, self.compression = open(path, "wb"), chunk, [], {}, compression
        self.file.write(MAGIC + record(1, text("") + text("test")))

    def message(self, topic, schema_name, data, log_ns, encoding="cdr", publisher=""):
        """Each publisher of a topic has a channel of its own."""
        key = (topic, publisher)
        if key not in self.topics:
            number = self.topics[key] = len(self.topics) + 7
            self.put(record(3, struct.pack("<H", number) + text(schema_name) + text("ros2msg") + text("")))
            self.put(record(4, struct.pack("<HH", number, number) + text(topic) + text(encoding) + struct.pack("<I", 0)))
        self.put(record(5, struct.pack("<HIQQ", self.topics[key], 0, log_ns, log_ns) + data))
        if self.chunk and len(self.waiting) >= self.chunk:
            self.end_chunk()

    def put(self, data):
        if self.chunk:
            self.waiting.append(data)
        else:
            self.file.write(data)

    def end_chunk(self):
        raw, self.waiting = b"".join(self.waiting), []
        content = struct.pack("<QQQI", 0, 0, len(raw), 0) + text(self.compression) + struct.pack("<Q", len(raw)) + raw
        self.file.write(record(6, content))

    def close(self):
        if self.waiting:
            self.end_chunk()
        self.file.write(record(15, struct.pack("<I", 0)) + record(2, struct.pack("<QQI", 0, 0, 0)) + MAGIC)
        self.file.close()
