"""A client of the Foxglove WebSocket, written from RFC 6455 and the public protocol, on plain sockets."""
import base64
import hashlib
import json
import os
import socket
import struct


class Client:
    def __init__(self, port, protocol="foxglove.websocket.v1"):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=30)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((
            f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
            f"Sec-WebSocket-Protocol: {protocol}\r\n\r\n").encode())
        self.stream = self.socket.makefile("rb")
        status = self.stream.readline().decode()
        headers = {}
        while line := self.stream.readline().decode().strip():
            name, value = line.split(":", 1)
            headers[name.lower()] = value.strip()
        accept = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
        assert " 101 " in status, status
        assert headers["sec-websocket-accept"] == base64.b64encode(accept).decode()
        assert headers["sec-websocket-protocol"] == protocol
        self.info = self.text()
        self.channels = {one["topic"]: one for one in self.text()["channels"]}

    def frame(self):
        """(opcode, payload) of the next frame; frames of a server are whole and not masked here."""
        first, size = self.stream.read(2)
        assert first & 0x80 and not size & 0x80
        if size == 126:
            (size,) = struct.unpack(">H", self.stream.read(2))
        elif size == 127:
            (size,) = struct.unpack(">Q", self.stream.read(8))
        return first & 15, self.stream.read(size)

    def text(self):
        opcode, payload = self.frame()
        assert opcode == 1
        return json.loads(payload)

    def say(self, message):
        payload = json.dumps(message).encode()
        size = bytes([0x80 | len(payload)]) if len(payload) < 126 else \
            b"\xfe" + struct.pack(">H", len(payload))
        mask = os.urandom(4)
        self.socket.sendall(b"\x81" + size + mask +
                            bytes(byte ^ mask[i % 4] for i, byte in enumerate(payload)))

    def subscribe(self, *topics):
        self.topics = dict(enumerate(topics, start=100))
        self.say({"op": "subscribe", "subscriptions": [
            {"id": i, "channelId": self.channels[topic]["id"]} for i, topic in self.topics.items()]})

    def message(self):
        """(topic, time in ns, object) of the next message."""
        while True:
            opcode, payload = self.frame()
            if opcode == 9:
                continue
            assert opcode == 2 and payload[0] == 1, (opcode, payload[:80])
            subscription, time_ns = struct.unpack("<IQ", payload[1:13])
            return self.topics[subscription], time_ns, json.loads(payload[13:])
