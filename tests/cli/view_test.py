"""view: the server of the page, from loopback."""

import base64
import http.client
import json
import re
import signal
import socket
import subprocess
import threading
import time
import zlib

import pytest

JSON = {"Content-Type": "application/json"}


class Server:
    def __init__(self, build, folder, *arguments):
        command = [str(build / "beeline"), "view", "ur5", *arguments, "--no-browser", "--page", "page"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder,
                                        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:"), self.process.stderr.read()
        self.port = int(self.address.rstrip("/").rsplit(":", 1)[1])

    def ask(self, method, path, body=None, headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        try:
            connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return answer.status, answer.read().decode(), answer
        finally:
            connection.close()

    def post(self, q):
        return self.ask("POST", "/api/joints", json.dumps({"q": q}), JSON)[0]

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            self.process.wait(timeout=20)
        self.process.stdout.close()
        self.process.stderr.close()
        return self.process.returncode


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "page").mkdir()
    (tmp_path / "page" / "index.html").write_text("<body><p>the page</p>")
    (tmp_path / "page" / "core.wasm").write_bytes(b"\0asm")
    (tmp_path / "secret").write_text("secret")
    (tmp_path / "page" / "link").symlink_to(tmp_path / "secret")
    return tmp_path


@pytest.fixture
def server(build, folder):
    server = Server(build, folder, "--port", str(free_port()))
    yield server
    server.stop()


class Events:
    """The events of one page, received in a thread. Waits for the server to notice that pages are closed."""

    def __init__(self, server):
        for _ in range(1000):
            self.connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=20)
            self.connection.request("GET", "/api/events")
            self.socket = self.connection.sock
            self.answer = self.connection.getresponse()
            if self.answer.status != 503:
                break
            self.connection.close()
            time.sleep(0.01)
        assert self.answer.status == 200
        self.received = []
        self.thread = threading.Thread(target=self.read, daemon=True)
        self.thread.start()

    def read(self):
        try:
            for line in self.answer:
                if line.startswith(b"data: "):
                    self.received.append((time.monotonic(), json.loads(line[6:])))
        except (OSError, ValueError, AttributeError, http.client.HTTPException):
            pass

    def wait(self, sequence):
        for _ in range(2000):
            if self.received and self.received[-1][1]["sequence"] >= sequence:
                return self.received[-1][1]
            time.sleep(0.01)
        raise AssertionError(f"event {sequence} did not come: {self.received[-3:]}")

    def close(self):
        self.socket.shutdown(socket.SHUT_RDWR)  # ends the thread, which holds what close() waits for
        self.thread.join()
        self.connection.close()


def test_it_serves_the_files_of_the_page_and_nothing_else(server):
    status, text, answer = server.ask("GET", "/")
    assert (status, text) == (200, '<body data-session="api/session"><p>the page</p>')
    assert "text/html" in answer.getheader("Content-Type")
    assert "default-src 'self'" in answer.getheader("Content-Security-Policy")
    assert server.ask("GET", "/core.wasm")[2].getheader("Content-Type") == "application/wasm"
    for path in ["/../secret", "/%2e%2e/secret", "/..%2fsecret", "//etc/passwd", "/link", "/page", "/index.html%00",
                 "/..%5csecret", "/./../secret"]:
        status, text, _ = server.ask("GET", path)
        assert status in (400, 404) and "secret" not in text, (path, status, text)


def test_the_session_has_the_scene_and_the_shapes(build, folder):
    (folder / "cell.json").write_text(json.dumps({"obstacles": [{"name": "post", "shapes": [{"sphere": {"radius": 0.1}}]}],
                                                  "allowed_pairs": [["post", "shoulder_link"]]}))
    server = Server(build, folder, "--port", str(free_port()), "--scene", "cell.json", "--clearance", "0.02", "--allow",
                    "post,forearm_link")
    session = json.loads(server.ask("GET", "/api/session")[1])
    assert server.stop() == 0
    scene = json.loads(session["scene"])
    assert [obstacle["name"] for obstacle in scene["obstacles"]] == ["post"]
    assert scene["allowed_pairs"] == [["post", "shoulder_link"], ["post", "forearm_link"]]
    assert session["clearance"] == 0.02
    shapes = json.loads(session["arm"])["shapes"]
    assert [body["name"] for body in shapes][:3] == ["base_link", "shoulder_link", "upper_arm_link"]


def test_without_a_scene_the_session_has_none(server):
    session = json.loads(server.ask("GET", "/api/session")[1])
    assert session["scene"] is session["clearance"] is None and "shapes" not in json.loads(session["arm"])


def test_nothing_is_compressed_which_would_take_seconds_for_the_page(server, folder):
    # Where cpp-httplib is built with Brotli it compresses texts at the highest level.
    (folder / "page" / "large.js").write_text("x" * 100_000)
    for path in ["/large.js", "/", "/api/session"]:
        _, text, answer = server.ask("GET", path, headers={"Accept-Encoding": "gzip, deflate, br"})
        assert answer.getheader("Content-Encoding") is None
        assert int(answer.getheader("Content-Length")) == len(text)


def test_the_session_holds_the_arm_and_the_trajectory(build, folder, beeline):
    moved = beeline("move", "ur5", "--from", "0,-1,1,0,1,0", "--to", "0.5,-1,1,0,1,0", "--out", "move.csv")
    assert moved.code == 0
    server = Server(build, folder, "move.csv", "--port", str(free_port()))
    session = json.loads(server.ask("GET", "/api/session")[1])
    server.stop()
    assert json.loads(session["arm"])["name"] == "ur5"
    assert session["trajectory"].startswith("t,joint1")


def test_a_trajectory_as_json_is_played_too(build, folder, beeline):
    move = ["move", "ur5", "--from", "0,-1,1,0,1,0", "--to", "0.5,-1,1,0,1,0"]
    assert beeline(*move, "--out", "move.json").code == 0
    server = Server(build, folder, "move.json", "--port", str(free_port()))
    header, *rows = json.loads(server.ask("GET", "/api/session")[1])["trajectory"].splitlines()
    server.stop()
    written = json.loads((folder / "move.json").read_text())
    names = written.get("joint_trajectory", written)["joint_names"]
    points = written.get("joint_trajectory", written)["points"]
    assert header.split(",")[: 1 + len(names)] == ["t", *names]
    assert [float(value) for value in rows[-1].split(",")[1:7]] == points[-1]["positions"]
    assert len(rows) == len(points)


@pytest.mark.parametrize("signal_", [signal.SIGINT, signal.SIGTERM], ids=lambda value: value.name)
def test_a_signal_ends_it_with_exit_code_0(server, signal_):
    page = Events(server)
    assert server.post([0] * 6) == 204
    server.process.send_signal(signal_)
    assert server.process.wait(timeout=20) == 0
    assert server.process.stderr.read() == ""
    page.close()


def test_joint_values_reach_every_page_the_latest_at_once(server):
    pages = [Events(server) for _ in range(8)]
    for i in range(1, 61):
        assert server.post([i / 100, 0, 0, 0, 0, 0]) == 204
    for page in pages:
        assert page.wait(60)["q"][0] == 0.6
        numbers = [event["sequence"] for _, event in page.received]
        assert numbers == sorted(set(numbers))
    late = Events(server)
    assert late.wait(60)["q"][0] == 0.6
    for page in [*pages, late]:
        page.close()


@pytest.mark.parametrize("body", [b"", b"{", b"[]", b'{"q": [1, 2]}', b'{"q": "a"}', b'{"q": [1,2,3,4,5,1e999]}',
                                  b'{"q": [1,2,3,4,5,NaN]}', b'{"p": [1,2,3,4,5,6]}', b"[" * 60000,
                                  b'{"q": [0,0,0,0,0,0], "q": [0,0,0,0,0,0]}', b"\xff\xfe"])
def test_malformed_joint_values_are_refused_and_the_server_lives(server, body):
    status, text, _ = server.ask("POST", "/api/joints", body, JSON)
    assert status == 400 and json.loads(text)["error"]["message"], text
    assert server.post([0] * 6) == 204


def test_other_sites_are_refused(server):
    own = f"127.0.0.1:{server.port}"
    good = json.dumps({"q": [0] * 6})
    for headers in [{"Host": "evil.example"}, {"Host": f"evil.example:{server.port}"}, {"Host": "127.0.0.1:1"},
                    {"Host": own, "Origin": "http://evil.example"}, {"Host": own, "Origin": "null"},
                    {"Host": own, "Origin": f"https://{own}"}]:
        assert server.ask("POST", "/api/joints", good, {**JSON, **headers})[0] == 403, headers
        assert server.ask("GET", "/api/session", None, headers)[0] == 403, headers
    for headers in [{"Host": f"localhost:{server.port}"}, {"Host": own, "Origin": f"http://{own}"},
                    {"Host": f"192.168.0.5:{server.port}"}, {"Host": f"[::1]:{server.port}"}]:
        assert server.ask("POST", "/api/joints", good, {**JSON, **headers})[0] == 204, headers
    # a form of another site, which sends no question before
    assert server.ask("POST", "/api/joints", good, {"Content-Type": "text/plain"})[0] == 415


def test_a_body_of_100_megabytes_is_refused(server):
    size = 100_000_000
    with socket.create_connection(("127.0.0.1", server.port), timeout=20) as connection:
        head = (f"POST /api/joints HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nContent-Type: application/json\r\n"
                f"Content-Length: {size}\r\n\r\n")
        connection.sendall(head.encode())
        try:
            for _ in range(size // 1_000_000):
                connection.sendall(b" " * 1_000_000)
            answer = connection.recv(100)
        except (BrokenPipeError, ConnectionResetError):  # refused before all of it was sent
            answer = b""
    assert answer == b"" or b" 413 " in answer, answer
    assert server.post([0] * 6) == 204
    status = open(f"/proc/{server.process.pid}/status").read()
    peak = next(line for line in status.splitlines() if line.startswith("VmHWM"))
    assert int(peak.split()[1]) < 500_000, peak  # kB, sanitizers included


def test_so_many_pages_that_programs_are_still_answered(server):
    pages = [Events(server) for _ in range(48)]
    assert server.ask("GET", "/api/events")[0] == 503
    assert server.post([1, 0, 0, 0, 0, 0]) == 204
    for page in pages:
        page.close()


def test_the_time_of_joint_values_is_passed_on(server):
    page = Events(server)
    assert server.ask("POST", "/api/joints", '{"q": [0, 0, 0, 0, 0, 0], "time": 1.25}', JSON)[0] == 204
    assert page.wait(1)["time"] == 1.25
    assert server.ask("POST", "/api/joints", '{"q": [0, 0, 0, 0, 0, 0], "time": "now"}', JSON)[0] == 400
    page.close()


def test_pages_that_close_make_room_for_others(server):
    for _ in range(3):
        for page in [Events(server) for _ in range(48)]:
            page.close()
    assert server.post([1, 0, 0, 0, 0, 0]) == 204
    page = Events(server)
    assert page.wait(1)["q"][0] == 1
    page.close()


def test_it_restarts_on_the_same_port_and_takes_the_next_where_it_is_taken(build, folder):
    port = str(free_port())
    first = Server(build, folder, "--port", port)
    page = Events(first)
    second = Server(build, folder, "--port", port)
    assert str(first.port) == port and second.port > first.port
    assert second.stop() == 0 and first.stop() == 0
    page.close()
    again = Server(build, folder, "--port", port)
    assert str(again.port) == port
    assert again.post([0] * 6) == 204
    assert again.stop() == 0


def element(text, name):
    """What a saved page's element holds, inflated."""
    held = re.search(f'id="saved-{name}">([^<]*)</script>', text)[1]
    return zlib.decompress(base64.urlsafe_b64decode(held + "=" * (-len(held) % 4)), wbits=-15)


def test_the_page_is_saved_as_one_file(beeline, folder):
    core = bytes(range(256)) * 600  # more than a block of the stream
    (folder / "page" / "core.wasm").write_bytes(core)
    script = '<script type="text/plain" id="saved-{}"{}></script>'
    elements = [script.format("state", ""), script.format("trajectory", ""),
                script.format("core-module", ' data-file="core.wasm"'), "x.split(' data-file=\"')"]
    (folder / "page" / "saved.html").write_text("\n".join(elements))
    move = ["move", "ur5", "--from", "0,-1,1,0,1,0", "--to", "0.5,-1,1,0,1,0", "--out", "move.csv"]
    assert beeline(*move).code == 0
    answer = beeline("view", "ur5", "move.csv", "--page", "page", "--save", "ur5.html", "--json")
    assert answer.code == 0 and json.loads(answer.out)["page"] == "ur5.html"
    text = (folder / "ur5.html").read_text()
    assert element(text, "core-module") == core and "data-file=\"core" not in text and text.endswith(elements[-1])
    assert element(text, "trajectory").decode() == (folder / "move.csv").read_text()
    words = dict(word.split("=") for word in re.search('id="saved-state">([^<]*)<', text)[1].split("&"))
    assert words["section"] == "line"
    arm = words["json"]
    assert json.loads(zlib.decompress(base64.urlsafe_b64decode(arm + "=" * (-len(arm) % 4)), wbits=-15))["name"] == "ur5"


def test_the_page_begins_in_a_section(beeline, refused, build, folder):
    (folder / "page" / "saved.html").write_text('<script type="text/plain" id="saved-state"></script>')
    answer = beeline("view", "rrr", "--section", "control", "--page", "page", "--save", "rrr.html")
    assert answer.code == 0 and (folder / "rrr.html").read_text().endswith("&section=control</script>")
    for arguments, section in ((["--section", "lessons"], "lessons"), ([], None)):
        server = Server(build, folder, "--port", str(free_port()), *arguments)
        try:
            assert json.loads(server.ask("GET", "/api/session")[1])["section"] == section
        finally:
            server.stop()
    refused(2, "view", "rrr", "--section", "hold", says=["--section", "hold", "pose", "workspace"])


def test_what_cannot_be_saved_is_refused(refused, folder):
    refused(2, "view", "ur5", "--page", "page", "--save", "ur5.pdf", says=["--save", ".html"])
    refused(2, "view", "ur5", "--page", "page", "--save", "ur5.html", says=["saved.html", "make web"])
    refused(3, "view", "ur5", "no.csv", "--page", "page", "--save", "ur5.html", says=["no.csv"])


def test_it_refuses_a_folder_without_the_page_and_a_wrong_trajectory(refused, written, tmp_path):
    (tmp_path / "empty").mkdir()
    refused(2, "view", "ur5", "--no-browser", "--page", "empty", says=["empty", "index.html"])
    written("a.csv", "t,a\n0,1\n")
    refused(3, "view", "ur5", "a.csv", "--no-browser", says=["a.csv"])
    refused(2, "view", "ur5", "--port", "0", says=["--port"])
