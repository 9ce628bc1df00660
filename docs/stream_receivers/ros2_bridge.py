#!/usr/bin/env python3
"""Publishes what Palpate streams as ROS 2 topics: an image per matrix, and the joint states.

    palpate stream --dsa PORT --sdh PORT --to tactile --to signals
    python3 ros2_bridge.py [TACTILE_PORT SIGNALS_PORT]
"""
import array, json, math, select, socket, sys
import rclpy
from sensor_msgs.msg import Image, JointState

rclpy.init()
node = rclpy.create_node("palpate")
images, fractions = {}, set()
joints = node.create_publisher(JointState, "joint_states", 10)
ports = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
for port, number in zip(ports, sys.argv[1:] or (9871, 9870)):
    port.bind(("127.0.0.1", int(number)))
while rclpy.ok():
    for port in select.select(ports, [], [], 0.1)[0]:
        message = json.loads(port.recv(65536))
        for matrix in message.get("tactile_matrix", []):
            image, name = Image(), f"tactile/m{matrix['matrix_id']}"
            stamp = message["header"]["stamp"]
            image.header.stamp.sec, image.header.stamp.nanosec = stamp["secs"], stamp["nsecs"]
            image.header.frame_id = name
            image.width, image.height = matrix["cells_x"], matrix["cells_y"]
            values = matrix["tactile_array"]
            if not all(isinstance(v, int) and 0 <= v < 2**16 for v in values):
                fractions.add(name)  # newtons, kPa, filtered values
            image.encoding = "32FC1" if name in fractions else "mono16"
            image.step = (4 if name in fractions else 2) * image.width
            image.data = array.array("f" if name in fractions else "H", values).tobytes()
            if name not in images:
                images[name] = node.create_publisher(Image, name, 10)
            images[name].publish(image)
        if "angles_deg" in message:
            state, us = JointState(), round(message["t"] * 1e6)
            state.header.stamp.sec, state.header.stamp.nanosec = us // 10**6, us % 10**6 * 1000
            state.name = [f"axis_{i}" for i in range(len(message["angles_deg"]))]
            state.position = [math.radians(deg) if deg is not None else math.nan
                              for deg in message["angles_deg"]]
            joints.publish(state)
