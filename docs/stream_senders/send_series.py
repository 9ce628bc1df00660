#!/usr/bin/python3
"""Sends rows of a load cell as lines of text: send_series.py PORT [ROWS]
The other end: palpate record .. --series cell=tcp:127.0.0.1:PORT -o a.palpate"""
import socket
import sys
import time

port = int(sys.argv[1])
rows = int(sys.argv[2]) if len(sys.argv) > 2 else 10**9


def read_sensor(n):  # replace by your sensor: one number per column
    return 0.5 * n, -n


with socket.create_server(("127.0.0.1", port)) as server:
    print(server.getsockname()[1], flush=True)
    stream, _ = server.accept()
    with stream:
        stream.sendall(b"time_us,force[N],count\n")
        for n in range(rows):
            numbers = (time.monotonic_ns() // 1000, *read_sensor(n))
            stream.sendall((",".join(map(str, numbers)) + "\n").encode())
            time.sleep(0.01)
