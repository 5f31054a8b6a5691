#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The server of `nef studio` by plain connections: who is let in, what bad clients get, how it ends.

Usage: server_test.py NEF. Exits with 77 if this build has no studio.
"""
import contextlib
import http.client
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse

NEF = sys.argv[1]


class Server:
    """A running studio in a folder of its own."""

    def __init__(self, root, *options):
        self.process = subprocess.Popen([NEF, "studio", "--root", str(root), "--no-browser", *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            error = self.process.stderr.read().strip()
            if "not built" in error or "not part of this build" in error:
                print(f"skipped: {error}")
                sys.exit(77)
            raise AssertionError(error)
        parts = urllib.parse.urlsplit(self.address)
        self.port = parts.port
        self.token = urllib.parse.parse_qs(parts.query)["token"][0]

    def ask(self, name, request=None, body=None, timeout=60, **headers):
        """(status, body) of a request as the page makes it, but for `headers` (an underscore stands for a hyphen)."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        given = {"X-Nef-Token": self.token, **{key.replace("_", "-"): value for key, value in headers.items()}}
        given = {key: value for key, value in given.items() if value is not None}
        try:
            connection.request("POST", f"/api/{name}", body if body is not None else json.dumps({"page": "a", **(request or {})}),
                               given)
            reply = connection.getresponse()
            return reply.status, reply.read()
        finally:
            connection.close()

    def raw(self, *pieces, timeout=20):
        """What comes back for bytes that are sent as they are."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=timeout) as connection:
            got = b""
            with contextlib.suppress(ConnectionError):
                for piece in pieces:
                    connection.sendall(piece)
                while chunk := connection.recv(65536):
                    got += chunk
            with contextlib.suppress(ConnectionError):
                while chunk := connection.recv(65536):
                    got += chunk
            return got

    @property
    def pid(self):
        return self.process.pid  # nef has become the server

    def memory(self):
        for line in pathlib.Path(f"/proc/{self.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) * 1024
        raise AssertionError("no VmRSS")

    def end(self, how=signal.SIGTERM, seconds=10):
        self.process.send_signal(how)
        code = self.process.wait(seconds)
        self.process.stdout.close()
        self.process.stderr.close()
        return code


@contextlib.contextmanager
def studio(*options, root=None):
    with tempfile.TemporaryDirectory() as folder:
        server = Server(root or folder, *options)
        server.root = pathlib.Path(root or folder)
        try:
            yield server
        finally:
            if server.process.poll() is None:
                server.process.kill()
                server.process.wait()


def one_line(text):
    text = text.decode() if isinstance(text, bytes) else text
    assert text.strip() and "\n" not in text.strip(), text
    return text


def status_of(reply):
    assert reply.startswith(b"HTTP/1.1 "), reply[:200]
    return int(reply.split()[1])


def test_the_page_needs_the_token_and_brings_its_policy():
    with studio() as server:
        head = f"Host: 127.0.0.1:{server.port}\r\n\r\n".encode()
        page = server.raw(b"GET /?token=" + server.token.encode() + b" HTTP/1.1\r\n" + head)
        assert status_of(page) == 200
        assert b"Content-Security-Policy: default-src 'none'" in page and b"frame-ancestors 'none'" in page
        assert b"<title>nef studio</title>" in page
        assert server.token.encode() not in page, "the page itself must not hold the token"
        for query in (b"", b"?token=", b"?token=" + b"0" * 32):
            assert status_of(server.raw(b"GET /" + query + b" HTTP/1.1\r\n" + head)) == 403


def test_other_sites_are_refused_in_one_line():
    with studio() as server:
        assert server.ask("start")[0] == 200
        for headers in ({"X_Nef_Token": None}, {"X_Nef_Token": "f" * 32}, {"Origin": "http://evil.example"},
                        {"Origin": "null"}, {"Origin": f"http://127.0.0.1:{server.port + 1}"}):
            status, text = server.ask("start", **headers)
            assert status == 403, (headers, status)
            one_line(text)
        for host in ("evil.example", f"evil.example:{server.port}", "127.0.0.1"):
            status, text = server.ask("start", Host=host)
            assert status == 421, (host, status)
            one_line(text)
        assert server.ask("start", Origin=f"http://127.0.0.1:{server.port}")[0] == 200


def test_only_the_loopback_is_bound():
    with studio() as server:
        listening = [line.split()[1] for line in pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:]
                     if line.split()[3] == "0A" and int(line.split()[1].split(":")[1], 16) == server.port]
        assert listening == [f"0100007F:{server.port:04X}"], listening


def test_nothing_outside_of_the_root_is_read_or_written():
    with tempfile.TemporaryDirectory() as folder:
        outside = pathlib.Path(folder)
        root = outside / "root"
        root.mkdir()
        cube = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
        (outside / "secret.off").write_text(cube)
        (outside / "secret.json").write_text("{}")
        (root / "link.off").symlink_to(outside / "secret.off")
        (root / "link.json").symlink_to("../secret.json")
        (root / "up").symlink_to(outside)
        with studio(root=root) as server:
            for name in ("../secret.off", "link.off", "up/secret.off", str(outside / "secret.off")):
                status, text = server.ask("compute", {"panel": "sets", "text": f'file("{name}")'})
                assert status == 422 and b"below the folder" in text, (name, status, text)
            for name in ("../secret.json", "link.json", "up/secret.json", "/etc/passwd"):
                status, text = server.ask("read", {"name": name})
                assert status == 422, (name, status, text)
                one_line(text)
                status, text = server.ask("write", {"name": name.replace("secret", "new"), "text": "x", "overwrite": True})
                assert status == 422, (name, status, text)
            assert server.ask("compute", {"panel": "sets", "text": "everything"})[0] == 200
            for name in ("../out.off", "up/out.off", "link.off"):
                status, text = server.ask("export", {"set": "result", "name": name, "overwrite": True})
                assert status == 422, (name, status, text)
            assert server.ask("upload", body=b"../new.off\nOFF")[0] == 422
            listed = json.loads(server.ask("files")[1])["files"]
            assert listed == [], listed
        assert sorted(path.name for path in outside.iterdir()) == ["root", "secret.json", "secret.off"]
        assert (outside / "secret.off").read_text() == cube and (outside / "secret.json").read_text() == "{}"


def test_large_and_endless_requests_are_cut_off_in_bounded_memory():
    with studio() as server:
        server.ask("start")
        before = server.memory()
        own = f"Host: 127.0.0.1:{server.port}\r\nX-Nef-Token: {server.token}\r\n".encode()
        post = b"POST /api/compute HTTP/1.1\r\n" + own
        begun = time.monotonic()
        assert status_of(server.raw(post + b"Content-Length: 10000000000\r\n\r\n", b"x" * 100000)) == 413
        assert status_of(server.raw(post + b"\r\n")) == 411
        assert status_of(server.raw(post + b"Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n")) == 415
        assert status_of(server.raw(post + b"Content-Length: 5\r\nContent-Encoding: gzip\r\n\r\nhello")) == 415
        assert status_of(server.raw(post + b"Content-Length: -5\r\n\r\nhello")) == 411
        assert status_of(server.raw(b"PUT /api/compute HTTP/1.1\r\n" + own + b"Content-Length: 0\r\n\r\n")) == 405
        # Neither a line nor a head without an end is kept.
        block = b"a" * 65536
        for request in ((b"GET /" + block,) + (block,) * 200, (post + b"X-Long: " + block,) + (block,) * 200,
                        (post,) + (b"X-Many: 1\r\n" * 5000,) * 40):
            reply = server.raw(*request)
            assert reply == b"" or 400 <= status_of(reply) < 500, reply[:100]
        # Without a token not even a body that states its length.
        strange = b"POST /api/upload HTTP/1.1\r\n" + f"Host: 127.0.0.1:{server.port}\r\n".encode()
        reply = server.raw(strange + b"Content-Length: 60000000\r\n\r\n", *(block,) * 100)
        assert reply == b"" or status_of(reply) == 403, reply[:100]
        # Texts are bounded more tightly than uploads.
        status, text = server.ask("compute", {"panel": "sets", "text": "#" * 20_000_000})
        assert status == 422
        one_line(text)
        assert time.monotonic() - begun < 60
        assert server.memory() - before < 150 << 20, (before, server.memory())
        assert server.ask("start")[0] == 200


def test_slow_clients_do_not_hold_the_others_up():
    with studio() as server:
        own = f"Host: 127.0.0.1:{server.port}\r\nX-Nef-Token: {server.token}\r\n".encode()
        slow = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(8)]
        begun = time.monotonic()
        for connection in slow:
            connection.sendall(b"POST /api/start HTTP/1.1\r\n" + own)
        ended = None
        while ended is None and time.monotonic() - begun < 20:
            time.sleep(0.4)
            assert server.ask("start", timeout=5)[0] == 200
            try:
                for connection in slow:
                    connection.sendall(b"X")  # a header that never ends
                    connection.setblocking(False)
                    try:
                        if connection.recv(1000) == b"":
                            ended = time.monotonic() - begun
                    except BlockingIOError:
                        pass
                    connection.setblocking(True)
            except ConnectionError:
                ended = time.monotonic() - begun
        assert ended is not None and ended < 10, ended
        for connection in slow:
            connection.close()


def test_a_thousand_connections_are_served_or_refused():
    with studio() as server:
        server.ask("start")
        before = server.memory()
        idle = []
        refused = 0
        for _ in range(1000):
            connection = socket.create_connection(("127.0.0.1", server.port), timeout=10)
            idle.append(connection)
        time.sleep(0.5)
        for connection in idle:
            connection.setblocking(False)
            try:
                got = connection.recv(1000)
                assert got == b"" or status_of(got) == 503, got
                if got:
                    one_line(got.split(b"\r\n\r\n")[1])
                refused += 1
            except BlockingIOError:
                pass
            except ConnectionError:
                refused += 1
        assert refused >= 900, refused
        assert server.memory() - before < 64 << 20, (before, server.memory())
        threads = len(os.listdir(f"/proc/{server.pid}/task"))
        assert threads < 80, threads
        # Those who have sent nothing are cut off after a few seconds; then there is room again.
        deadline = time.monotonic() + 15
        while True:
            with contextlib.suppress(OSError, http.client.HTTPException):
                if server.ask("start", timeout=5)[0] == 200:
                    break
            assert time.monotonic() < deadline, "no room again"
            time.sleep(0.3)
        for connection in idle:
            connection.close()


def test_computations_end_at_their_limits():
    with studio("--time", "2", "--memory", "4000") as server:
        begun = time.monotonic()
        status, text = server.ask("compute", {"panel": "sets", "text": "minkowski(sphere(1, 200) - box(0,0,0, 1,1,1), sphere(1, 90))"})
        assert status == 422 and b"--time" in text, (status, text[:200])
        one_line(text)
        assert time.monotonic() - begun < 20
        assert server.ask("compute", {"panel": "sets", "text": "box(0,0,0, 1,1,1)"})[0] == 200
    with studio("--memory", "64") as server:
        status, text = server.ask("compute", {"panel": "sets", "text": "minkowski(sphere(1, 200) - box(0,0,0, 1,1,1), sphere(1, 90))"})
        assert status == 422 and b"--memory" in text, (status, text[:200])


def test_it_ends_when_it_is_asked_to_also_in_the_middle_of_a_computation():
    for how in (signal.SIGTERM, signal.SIGINT, "stop"):
        with studio() as server:
            outcome = []

            def compute():
                with contextlib.suppress(OSError, http.client.HTTPException):
                    outcome.append(server.ask("compute", {"panel": "sets", "text": "minkowski(sphere(1, 200) - box(0,0,0, 1,1,1), sphere(1, 90))"})[0])

            computing = threading.Thread(target=compute)
            computing.start()
            while not json.loads(server.ask("progress")[1])["running"]:
                time.sleep(0.05)
            if how == "stop":
                assert server.ask("stop")[0] == 200
                assert server.process.wait(15) == 0
            else:
                assert server.end(how, 15) == 0
            computing.join()
            assert outcome in ([], [409]), outcome
            assert list(server.root.iterdir()) == []


def test_files_are_whole_when_the_server_is_killed_while_it_writes():
    with tempfile.TemporaryDirectory() as root:
        last = None
        for round_ in range(6):
            with studio(root=root) as server:
                state = json.loads(server.ask("start")[1])
                if last is not None:
                    text = state["state"]
                    assert text in last, f"{len(text)} characters are none of the last two"
                last = [state["state"]]
                stop = time.monotonic() + 0.05 + 0.03 * round_
                killer = threading.Timer(0.05 + 0.03 * round_, server.process.kill)
                killer.start()
                number = 0
                with contextlib.suppress(OSError, http.client.HTTPException):
                    while time.monotonic() < stop + 1:
                        number += 1
                        text = json.dumps({"number": number, "long": "x" * 1_000_000})
                        last = [last[-1], text]
                        server.ask("state", {"text": text, "revision": 0, "overwrite": True})
                killer.join()
                server.process.wait()
            names = sorted(os.listdir(root))
            assert set(names) <= {"studio.nefstudio", ".studio.nefstudio.partial"}, names


def test_what_cannot_be_started_is_said_in_one_line():
    with studio() as server:
        for options, word in ((["--port", str(server.port)], "port"), (["--root", "/none/of/these"], "folder"),
                              (["none.off"], "none.off")):
            run = subprocess.run([NEF, "studio", "--no-browser", *options], capture_output=True, text=True, timeout=20, check=False)
            assert run.returncode == 2, run
            assert word in one_line(run.stderr), run.stderr
        assert server.end(signal.SIGHUP) == 0


def main():
    failed = 0
    for name, test in list(globals().items()):
        if not name.startswith("test_"):
            continue
        begun = time.monotonic()
        try:
            test()
            print(f"passed: {name[5:].replace('_', ' ')} ({time.monotonic() - begun:.1f} s)", flush=True)
        except Exception as error:  # pylint: disable=broad-except
            failed += 1
            print(f"FAILED: {name[5:].replace('_', ' ')}: {type(error).__name__}: {error}", flush=True)
            import traceback
            traceback.print_exc()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
