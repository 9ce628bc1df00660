"""Live bridges with the real program: Foxglove's WebSocket, PlotJuggler's datagrams, the bridge to ROS 2."""
import base64
import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import types

import numpy as np
import palpate
import pytest
from conftest import SOURCE
from foxglove_client import Client

jsonschema = pytest.importorskip("jsonschema")
PROGRAM = os.environ["PALPATE_PROGRAM"]
DEMO = SOURCE / "data/demo_grasps.dsa"


class Streaming:
    """`palpate stream` of a recording, until the block ends."""

    def __init__(self, *options, file=DEMO):
        self.arguments = [PROGRAM, "stream", str(file), *options]

    def __enter__(self):
        self.program = subprocess.Popen(self.arguments, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        return self

    def port(self):
        line = self.program.stdout.readline()
        return int(re.fullmatch(r"foxglove=ws://127\.0\.0\.1:(\d+)\n", line)[1])

    def end(self):
        if self.program.poll() is None:
            self.program.send_signal(signal.SIGINT)
        out, err = self.program.communicate(timeout=60)
        return self.program.returncode, out, err

    def __exit__(self, *_):
        self.end()


def first_of_each(client, topics):
    client.subscribe(*topics)
    found = {}
    while set(found) != set(topics):
        topic, time_ns, message = client.message()
        found.setdefault(topic, (time_ns, message))
    return found


def test_images_are_the_frames_of_the_recording():
    profile = palpate.load(DEMO)
    with Streaming("--foxglove", "0") as streaming:
        client = Client(streaming.port(), "foxglove.sdk.v1")
        topics = [topic for topic in client.channels if topic.endswith("/image")]
        assert topics[1] == "/tactile/finger_0_distal/image" and len(topics) == 6
        for topic, (time_ns, image) in first_of_each(client, topics).items():
            (frame,) = np.flatnonzero(profile.time_us * 1000 == time_ns)
            stamp = image["timestamp"]
            assert stamp["sec"] * 10**9 + stamp["nsec"] == time_ns
            values = np.frombuffer(base64.b64decode(image["data"], validate=True), "<u2")
            np.testing.assert_array_equal(values.reshape(image["height"], image["width"]),
                                          profile.matrix(topics.index(topic))[frame])
            assert image["encoding"] == "mono16" and image["step"] == 2 * image["width"]
        code, out, err = streaming.end()
        assert code == 0, err
        assert "1 client" in out and "0 dropped" in out


def test_messages_are_valid_by_the_schemas_that_are_advertised():
    with Streaming("--foxglove=0", "--image", "colored") as streaming:
        client = Client(streaming.port())
        assert client.info["op"] == "serverInfo"
        topics = [topic for topic in client.channels if topic != "/events"]
        assert {"/signals", "/joint_states", "/tf", "/hand/taxels"} < set(topics)
        for topic, (_, message) in first_of_each(client, topics).items():
            schema = json.loads(client.channels[topic]["schema"])
            jsonschema.validate(message, schema)
            assert schema["title"] == client.channels[topic]["schemaName"]
            assert set(message) <= set(schema["properties"])


def test_the_hand_in_space_is_that_of_the_kinematics():
    profile = palpate.load(DEMO)
    with Streaming("--foxglove", "0") as streaming:
        client = Client(streaming.port())
        topics = ["/hand/taxels", "/joint_states", "/signals"]
        client.subscribe(*topics)
        signals = {}
        while True:
            topic, time_ns, message = client.message()
            if topic == "/signals":
                signals[time_ns] = message
            if topic == "/hand/taxels" and time_ns in signals:
                break
        angles = signals[time_ns]["angles_deg"]
        pose = palpate.kinematics(angles)
        points = np.frombuffer(base64.b64decode(message["data"]), np.dtype(
            [("at", "<f4", 3), ("value", "<f4"), ("rgba", "u1", 4)]))
        assert message["point_stride"] == 20 and len(points) == 456
        (frame,) = np.flatnonzero(profile.time_us * 1000 == time_ns)
        exists = np.concatenate([m["static_mask"].ravel() for m in profile.matrices])
        np.testing.assert_array_equal(points["value"], profile.frames()[frame][exists])
        assert (points["rgba"][:, 3] == 255).all()
        np.testing.assert_allclose(points["at"], pose["position_mm"][exists] / 1000, atol=1e-7)


def test_a_pad_without_joints_has_images_only(tmp_path):
    rng = np.random.default_rng(3)
    pad = palpate.record(rng.integers(0, 1000, (300, 16, 16)), "flat_pad_16x16", rate=30)
    pad.save(tmp_path / "pad.palpate")
    with Streaming("--foxglove", "0", file=tmp_path / "pad.palpate") as streaming:
        client = Client(streaming.port())
        assert "/joint_states" not in client.channels
        (topic,) = [topic for topic in client.channels if topic.endswith("/image")]
        _, image = first_of_each(client, [topic])[topic]
        assert (image["width"], image["height"]) == (16, 16)


def test_foxglove_reads_along_while_a_hand_is_recorded(tmp_path):
    emulator = subprocess.Popen([PROGRAM, "emulate", "--hand", "parallel_gripper", "--stream", "0"],
                                stdout=subprocess.PIPE, text=True)
    source = emulator.stdout.readline().strip().removeprefix("stream=")
    out = tmp_path / "a.palpate"
    recorder = subprocess.Popen([PROGRAM, "record", "--stream", source, "--hand", "parallel_gripper",
                                 "-o", str(out), "--to", "foxglove:0"], stderr=subprocess.PIPE, text=True)
    try:
        client = Client(int(recorder.stderr.readline().rsplit(":", 1)[1]))
        time_ns, image = first_of_each(client, ["/tactile/left_finger/image"])[
            "/tactile/left_finger/image"]
        recorder.send_signal(signal.SIGINT)
        assert recorder.wait(60) == 0, recorder.stderr.read()
    finally:
        recorder.kill()
        emulator.kill()
    recorded = palpate.load(out)
    (frame,) = np.flatnonzero(recorded.time_us * 1000 == time_ns)
    values = np.frombuffer(base64.b64decode(image["data"]),
                           "<u2" if image["encoding"] == "mono16" else "<f4")
    np.testing.assert_array_equal(values, recorded.matrix(0)[frame].ravel())


def test_wrong_usage_is_one_line():
    def fails(*options):
        result = subprocess.run([PROGRAM, "stream", str(DEMO), *options], capture_output=True, text=True)
        assert result.stderr.count("\n") == 1, result.stderr
        return result.returncode, result.stderr

    assert fails("--foxglove", "70000")[0] == 2
    assert fails("--to", "foxglove:x")[0] == 2
    assert fails("--foxglove", "--lines")[0] == 2
    assert fails("--listen", "0.0.0.0") == (2, "palpate: --listen needs --to foxglove\n")
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        code, text = fails("--foxglove", str(port))
        assert code == 1 and "another program uses this port" in text


def udp_port():
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind(("127.0.0.1", 0))
    receiver.settimeout(60)
    return receiver, receiver.getsockname()[1]


def test_datagrams_are_the_lines_in_parts():
    lines = subprocess.run([PROGRAM, "stream", str(DEMO), "--lines"], capture_output=True, text=True,
                           check=True).stdout.splitlines()
    receiver, port = udp_port()
    with receiver, Streaming("--to", f"signals:{port}"):
        frames = {}
        while len(frames) < 4:
            datagram = receiver.recv(65536)
            assert len(datagram) <= 1400
            part = json.loads(datagram)
            frames.setdefault(part["sequence"], {}).update(part)
    for sequence in range(3):
        whole = json.loads(lines[sequence])
        merged = frames[sequence]
        merged.pop("link")  # only of a source that runs
        assert merged == whole


class Recorded(types.SimpleNamespace):
    """A message that takes every field, and messages inside of it."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        value = Recorded()
        setattr(self, name, value)
        return value


def test_the_bridge_to_ros2_publishes_images_and_joints(monkeypatch):
    profile = palpate.load(DEMO)
    published = {}

    def create_publisher(kind, topic, depth):
        assert depth == 10
        found = published.setdefault(topic, [])
        return types.SimpleNamespace(publish=found.append)

    def ok():
        return len(published) < 7 or not all(published.values())

    rclpy = types.ModuleType("rclpy")
    rclpy.init = lambda: None
    rclpy.ok = ok
    rclpy.create_node = lambda name: types.SimpleNamespace(create_publisher=create_publisher)
    messages = types.ModuleType("sensor_msgs.msg")
    messages.Image = type("Image", (Recorded,), {})
    messages.JointState = type("JointState", (Recorded,), {})
    monkeypatch.setitem(sys.modules, "rclpy", rclpy)
    monkeypatch.setitem(sys.modules, "sensor_msgs", types.ModuleType("sensor_msgs"))
    monkeypatch.setitem(sys.modules, "sensor_msgs.msg", messages)
    script = SOURCE / "docs/stream_receivers/ros2_bridge.py"
    code = script.read_text()
    assert len([line for line in code.split('"""')[2].splitlines() if line.strip()]) <= 35
    assert code.split('"""\n')[-1].strip() in (SOURCE / "docs/notes/live_streams.md").read_text()
    free = [udp_port() for _ in range(2)]
    for receiver, _ in free:
        receiver.close()
    ports = [str(port) for _, port in free]
    monkeypatch.setattr(sys, "argv", [str(script), *ports])
    with Streaming("--to", f"tactile:{ports[0]}", "--to", f"signals:{ports[1]}"):
        exec(compile(code, str(script), "exec"), {"__name__": "__main__"})
    for m in range(6):
        image = published[f"tactile/m{m}"][0]
        time_us = image.header.stamp.sec * 10**6 + image.header.stamp.nanosec // 1000
        (frame,) = np.flatnonzero(profile.time_us == time_us)
        values = struct.unpack(f"<{image.width * image.height}H", image.data)
        np.testing.assert_array_equal(np.reshape(values, (image.height, image.width)),
                                      profile.matrix(m)[frame])
        assert (image.encoding, image.step) == ("mono16", 2 * image.width)
    state = published["joint_states"][0]
    time_us = state.header.stamp.sec * 10**6 + state.header.stamp.nanosec // 1000
    (frame,) = np.flatnonzero(profile.time_us == time_us)
    assert len(state.name) == 7
    np.testing.assert_allclose(np.degrees(state.position), profile.angles_at_frames()[frame], atol=1e-9)
