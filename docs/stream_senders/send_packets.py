#!/usr/bin/python3
"""Sends frames of a 16 x 16 pad as packets: send_packets.py HOST PORT [FRAMES]
The other end: palpate record --stream listen:PORT --hand FOLDER -o pad.palpate"""
import socket
import struct
import sys
import time
import zlib

host, port = sys.argv[1], int(sys.argv[2])
frames = int(sys.argv[3]) if len(sys.argv) > 3 else 10**9
FRAME_F32, DESCRIPTION = 2, 5


def packet(kind, number, payload):
    time_us = time.monotonic_ns() // 1000
    body = struct.pack("<BBIIQ", 1, kind, len(payload), number % 2**32, time_us) + payload
    return b"\xa5\x5a" + body + struct.pack("<I", zlib.crc32(body))


def read_sensor(n):  # replace by your sensor: one number per taxel, row by row
    return [(7 * n + 3 * k) % 1000 + 0.25 for k in range(256)]


with socket.create_connection((host, port)) as stream:
    about = b'{"name": "pad", "serial": "P7", "matrices": [{"rows": 16, "columns": 16}]}'
    stream.sendall(packet(DESCRIPTION, 0, about))
    for n in range(frames):
        stream.sendall(packet(FRAME_F32, n, struct.pack("<256f", *read_sensor(n))))
        time.sleep(0.001)
