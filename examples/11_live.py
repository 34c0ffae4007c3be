"""
A running program, live
=======================

A UR5 follows a circle, and posts its joint values 60 times a second to the page that `beeline view ur5` shows. Without
that command only the picture below is made.
"""

import http.client
import json
import sys
import time
import urllib.parse

import numpy as np

import beeline

arm = beeline.arms.ur5()
q = np.array([0.4, -1.2, 1.6, -1.9, -1.5, 0.0])
centre = beeline.forward_kinematics(arm, q)
rate = 60  # Hz, as screens show it

address = sys.argv[1] if len(sys.argv) > 1 else "http://127.0.0.1:8642"
server = http.client.HTTPConnection(urllib.parse.urlsplit(address).netloc, timeout=5)
try:
    server.connect()
    connected = True
except OSError:
    connected = False
    print(f"Nothing listens at {address}: start `beeline view ur5`, then run this again")

servo = beeline.Servo(arm, time_step=1 / rate)
times, positions = [], []
begin = time.monotonic()
for i in range(5 * rate):
    t = i / rate
    goal = np.array(centre)
    goal[:3, 3] += 0.1 * np.array([0, np.sin(2 * t), 1 - np.cos(2 * t)])
    command = 10 * beeline.pose_error(goal, beeline.forward_kinematics(arm, q), "base")
    q = q + servo.step(q, command).velocity / rate  # your robot or simulation
    times.append(t)
    positions.append(q)
    if connected:
        server.request("POST", "/api/joints", json.dumps({"q": list(q)}), {"Content-Type": "application/json"})
        answer = server.getresponse()
        reason = answer.read().decode()
        assert answer.status == 204, reason
        time.sleep(max(0, begin + t + 1 / rate - time.monotonic()))
server.close()

beeline.draw(arm, beeline.Trajectory(arm.joint_names, times, positions)).save("11_live.svg")
