"""Reads a .dsa by the rules of the program that the form comes from, strictly: bz2 and xml.etree, nothing of palpate.

    prior_program_reader.py FILE..

Says per file how many frames, temperatures and angles it holds; AssertionError names what that program would
refuse or read wrongly: an element that is missing, too many or in another order, a number that is none of its
kind (it reads generated_by, hw_revision and the counts as whole numbers), a count or index that is wrong, a
mask or frame of another size, runs of zeros that are not as long as they could be, stamps that don't grow.
"""
import bz2
import re
import struct
import sys
import xml.etree.ElementTree as tree

INTEGER = r"\d+"
REAL = r"-?\d+(\.\d+)?"
MATRIX = [("cells_x", INTEGER), ("cells_y", INTEGER), ("texel_width", REAL), ("texel_height", REAL),
          ("matrix_center_x", REAL), ("matrix_center_y", REAL), ("matrix_center_z", REAL),
          ("theta_x", REAL), ("theta_y", REAL), ("theta_z", REAL), ("output_unit", "mV"),
          ("hw_revision", INTEGER), ("one_wire_uid", ".+"), ("fullscale", INTEGER),
          ("static_mask", None), ("dynamic_mask", None)]


def leaf(element, name, pattern):
    assert element.tag == name, f"<{element.tag}> instead of <{name}>"
    assert len(element) == 0 and not element.attrib, f"<{name}> holds more than a value"
    text = element.text or ""
    assert pattern is None or re.fullmatch(pattern, text), f"<{name}>: {text!r}"
    return text


def children(element, names):
    assert [child.tag for child in element] == names, f"<{element.tag}>: {[c.tag for c in element][:20]}"
    return list(element)


def whole(text, bits):
    value = int(text)
    assert value < 2**bits, f"{text} doesn't fit {bits} bits"
    return value


def mask(element, name, columns, rows):
    lines = leaf(element, name, None).split()
    assert [len(line) for line in lines] == [columns] * rows, f"<{name}> of another size"
    assert set("".join(lines)) <= set("01"), f"<{name}> of other digits"


def read_matrix(element, index):
    assert element.attrib == {"index": str(index), "name": ""}, element.attrib
    parts = children(element, [name for name, _ in MATRIX])
    values = {name: leaf(part, name, pattern) for part, (name, pattern) in zip(parts, MATRIX)}
    columns, rows = whole(values["cells_x"], 16), whole(values["cells_y"], 16)
    mask(parts[14], "static_mask", columns, rows)
    mask(parts[15], "dynamic_mask", columns, rows)
    return columns * rows


def read_sensor(sensor):
    assert sensor.attrib == {"name": ""}
    head = ["generated_by", "hw_revision", "serial_nr", "num_matrices", "converter_resolution"]
    parts = children(sensor, head + ["matrix"] * (len(sensor) - len(head)))
    whole(leaf(parts[0], "generated_by", INTEGER), 16)
    whole(leaf(parts[1], "hw_revision", INTEGER), 8)
    leaf(parts[2], "serial_nr", "[0-9A-F]{8}")
    assert whole(leaf(parts[3], "num_matrices", INTEGER), 16) == len(parts) - len(head)
    leaf(parts[4], "converter_resolution", INTEGER)
    return sum(read_matrix(matrix, index) for index, matrix in enumerate(parts[len(head):]))


def check_frame(text, cells):
    hexadecimal = "".join(text.split())
    assert re.fullmatch("([0-9A-F]{8})*", hexadecimal), "frame_data is no row of tokens"
    decoded, run_before = 0, False
    for value, in struct.iter_unpack(">f", bytes.fromhex(hexadecimal)):
        is_run = value < 0.0
        assert value == value and abs(value) != float("inf"), "a value that is no number"
        assert not is_run or value == int(value), "a run of a fractional length"
        assert not (is_run and run_before), "two runs behind each other"
        assert is_run or value > 0.0, "a zero that is in no run"
        decoded += int(-value) if is_run else 1
        run_before = is_run
    assert decoded == cells, f"a frame of {decoded} cells instead of {cells}"


def samples(element, count_name, name, data_name, check):
    parts = children(element, [count_name] + [name] * (len(element) - 1))
    count = whole(leaf(parts[0], count_name, INTEGER), 31)
    assert count == len(parts) - 1, f"<{count_name}> says {count}, there are {len(parts) - 1}"
    last = None
    for index, sample in enumerate(parts[1:]):
        assert sample.attrib == {"index": str(index)}, sample.attrib
        stamp, data = children(sample, ["time_stamp", data_name])
        ms = whole(leaf(stamp, "time_stamp", INTEGER), 63)
        assert last is None or ms > last, f"{name} {index}: stamp {ms} behind {last}"
        last = ms
        check(leaf(data, data_name, None))
    return count


def numbers(count, decimals):
    pattern = re.compile(rf"-?\d+\.\d{{{decimals}}}(, -?\d+\.\d{{{decimals}}}){{{count - 1}}}")

    def check(text):
        assert pattern.fullmatch(text), f"{text!r} is not {count} numbers of {decimals} decimals"
    return check


def read(path):
    with open(path, "rb") as file:
        packed = file.read()
    assert packed[:3] == b"BZh", "no bzip2"
    decompressor = bz2.BZ2Decompressor()
    text = decompressor.decompress(packed)
    assert decompressor.eof and not decompressor.unused_data, "more or less than one bzip2 stream"
    assert text.startswith(b'<?xml version="1.0" encoding="utf-8"?>')
    root = tree.fromstring(text)
    assert root.tag == "root" and not root.attrib
    sensor, data, temperatures, angles = children(root, ["sensor", "data", "temperatures", "joint_angles"])
    cells = read_sensor(sensor)
    return (samples(data, "frame_count", "frame", "frame_data", lambda t: check_frame(t, cells)),
            samples(temperatures, "temp_count", "temp", "temp_data", numbers(9, 2)),
            samples(angles, "angle_count", "angle", "angle_data", numbers(7, 5)))


for name in sys.argv[1:]:
    try:
        print(*read(name))
    except AssertionError as wrong:
        sys.exit(f"{name}: {wrong}")
