#!/usr/bin/python3
"""Sends frames of a 16 x 16 pad as lines of text: send_lines.py HOST PORT [FRAMES]
The other end: palpate record --stream listen:PORT --hand FOLDER -o pad.palpate"""
import socket
import sys
import time

host, port = sys.argv[1], int(sys.argv[2])
frames = int(sys.argv[3]) if len(sys.argv) > 3 else 10**9


def read_sensor(n):  # replace by your sensor: one number per taxel, row by row
    return [(7 * n + 3 * k) % 1000 for k in range(256)]


with socket.create_connection((host, port)) as stream:
    for n in range(frames):
        time_ms = time.monotonic_ns() // 1_000_000
        numbers = [time_ms] + read_sensor(n)
        stream.sendall(f"frame#{n},{','.join(map(str, numbers))}\n".encode())
        time.sleep(0.01)
