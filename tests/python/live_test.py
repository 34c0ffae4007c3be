"""The examples that post joint values to `beeline view`, in Python and C++, with a server."""

import http.client
import json
import os
import re
import socket
import subprocess
import sys
import threading

import pytest


@pytest.fixture
def server(build, tmp_path):
    """The port of `beeline view ur5`, its page an empty one."""
    (tmp_path / "page").mkdir()
    (tmp_path / "page" / "index.html").write_text("<body></body>")
    port = str(30000 + os.getpid() % 20000)
    command = [build / "beeline", "view", "ur5", "--no-browser", "--page", "page", "--port", port]
    process = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    yield int(re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\n", process.stdout.readline())[1])
    process.terminate()
    assert process.wait(timeout=20) == 0
    process.stdout.close()


def follow(answer, received):
    for line in answer:
        if line.startswith(b"data: "):
            received.append(json.loads(line[6:]))
    return received


@pytest.mark.parametrize("language", ["py", "cpp"])
def test_a_page_follows_the_example(language, server, root, build, tmp_path):
    program = [build / "examples" / "11_live"]
    if language == "py":
        program = [sys.executable, "-B", root / "examples" / "11_live.py"]
    elif not program[0].exists():
        pytest.skip("the C++ examples are not built here")
    events = http.client.HTTPConnection("127.0.0.1", server, timeout=20)
    events.request("GET", "/api/events")
    stream, answer, received = events.sock, events.getresponse(), []
    reader = threading.Thread(target=follow, args=(answer, received))
    reader.start()
    environment = {name: value for name, value in os.environ.items() if language == "py" or name != "LD_PRELOAD"}
    done = subprocess.run([*program, f"http://127.0.0.1:{server}"], cwd=tmp_path, capture_output=True, text=True,
                          env=environment)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout == ""
    last = http.client.HTTPConnection("127.0.0.1", server, timeout=20)
    last.request("POST", "/api/joints", "{\"q\": [9, 0, 0, 0, 0, 0]}", {"Content-Type": "application/json"})
    assert last.getresponse().status == 204
    for _ in range(2000):
        if received and received[-1]["q"][0] == 9:
            break
        threading.Event().wait(0.01)
    assert received[-1]["sequence"] == 301  # 5 s at 60 Hz, and ours; a page that is late gets the latest
    assert len({tuple(event["q"]) for event in received}) > 30
    stream.shutdown(socket.SHUT_RDWR)  # ends the reader
    reader.join(timeout=20)


def test_without_a_server_it_says_what_to_start(root, tmp_path):
    address = "http://127.0.0.1:9"
    done = subprocess.run([sys.executable, "-B", root / "examples" / "11_live.py", address], cwd=tmp_path,
                          capture_output=True, text=True, check=True)  # fmt: skip
    assert done.stdout == f"Nothing listens at {address}: start `beeline view ur5`, then run this again\n"
    assert (tmp_path / "11_live.svg").exists()
