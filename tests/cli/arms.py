"""Configurations of the built-in arms, and how the command takes them."""

Q = {  # within limits, and not singular
    "rrr": "0.4,0.9,-0.7",
    "rp": "0.4,0.9",
    "puma560": "0.3,1,-1,0.4,0.8,0.2",
    "ur5": "0.3,-1,1,0.4,1.1,0.2",
    "panda": "0.3,-0.6,0.1,-2.2,0.1,1.7,0.9",
    "iiwa14": "0.3,0.6,0.1,-1.2,0.1,0.7,0.9",
    "stanford": "0.3,1,0.5,0.4,0.6,0.2",
    "scara": "0.3,1,0.5,0.1",
}


def text(values):
    return ",".join(map(repr, map(float, values)))


def joints(q):
    return [float(value) for value in q.split(",")]
