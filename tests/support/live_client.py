"""A live session and a page for it, in Python: what the tests of sessions share."""

import base64
import json
import os
import re
import socket
import struct
import subprocess
import tempfile
import time

import runner

FRAME = struct.Struct("<IIdIIffIIffI")


class Session:
    """supple --live, which ends with the block; what it wrote is in folder."""

    def __init__(self, scene, settings, ranks=1):
        self.folder = tempfile.mkdtemp(prefix="supple-")
        command = [runner.SUPPLE, "--live", str(scene), "--quiet", "--output", self.folder, *runner.overrides(settings)]
        if ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
        self.process = subprocess.Popen(command, env=runner.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        stdin=subprocess.DEVNULL)
        self.address, self.host, self.token = "", "", ""
        for line in self.process.stdout:
            if match := re.search(r"http://(127\.0\.0\.1:\d+)/\?token=(\w+)", line):
                self.address, self.host, self.token = match[0], match[1], match[2]
                break
        runner.check(self.host, f"no session: {self.process.stderr.read() if not self.host else ''}")
        self.port = int(self.host.split(":")[1])

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if self.process.poll() is None and kind:
            self.process.kill()
        self.end()

    def end(self):
        """Waits for it. Gives the exit status."""
        if self.process.poll() is None:
            self.process.communicate(timeout=100 * runner.PATIENCE)
        return self.process.returncode

    def memory(self):
        """What it has in memory, in MB."""
        with open(f"/proc/{self.process.pid}/status") as file:
            return float(re.search(r"VmRSS:\s+(\d+)", file.read())[1]) / 1024

    def connect(self):
        connection = socket.create_connection(("127.0.0.1", self.port), timeout=20 * runner.PATIENCE)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # as browsers do
        return connection

    def ask(self, lines, body=b""):
        """The answer to a request, as text, and whatever comes until the server closes."""
        with self.connect() as connection:
            connection.sendall("\r\n".join([*lines, "", ""]).encode() + body)
            answer = b""
            try:
                while part := connection.recv(1 << 16):
                    answer += part
                    if answer.startswith(b"HTTP/1.1 101"):
                        break
            except ConnectionResetError:
                pass
        return answer.decode(errors="replace")

    def surface(self):
        """Places at rest of the surface's vertices, by their index in the mesh, and the triangles."""
        with self.connect() as connection:
            connection.sendall(f"GET /surface?token={self.token} HTTP/1.1\r\nHost: {self.host}\r\n\r\n".encode())
            answer = b""
            while part := connection.recv(1 << 16):
                answer += part
        head, data = answer.split(b"\r\n\r\n", 1)
        runner.check(head.startswith(b"HTTP/1.1 200"), f"the surface: {head}")
        page = self.ask([f"GET /?token={self.token} HTTP/1.1", f"Host: {self.host}"])
        about = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])
        n, m = about["vertices"], about["triangles"]
        places = struct.unpack_from(f"<{3 * n}f", data)
        index = struct.unpack_from(f"<{n}I", data, 12 * n + 12 * m)
        runner.check(len(data) == 12 * n + 12 * m + 5 * n, f"{len(data)} octets of the surface")
        return {vertex: places[3 * i:3 * i + 3] for i, vertex in enumerate(index)}

    def upgrade_lines(self, token=None, host=None, origin=None):
        lines = [f"GET /socket?token={self.token if token is None else token} HTTP/1.1", f"Host: {host or self.host}",
                 "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                 f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}"]
        if origin != "":
            lines.append(f"Origin: {origin or 'http://' + self.host}")
        return lines


class Page:
    """The socket of a page. It is ready for two frames, and for another one after each; not so if it is told to be slow."""

    def __init__(self, session, slow=False):
        self.rest = session.surface()
        self.connection = session.connect()
        self.connection.sendall("\r\n".join([*session.upgrade_lines(), "", ""]).encode())
        head = b""
        while b"\r\n\r\n" not in head:
            head += self.connection.recv(1)
        runner.check(head.startswith(b"HTTP/1.1 101"), f"no socket: {head}")
        self.slow = slow
        self.number = 0
        self.frames, self.texts, self.rows = [], [], []
        self.closed = None
        self.octets = b""
        for _ in range(2):
            self.send("a")

    def send(self, text, kind=1):
        """A whole message, masked as the protocol has it."""
        data = text if isinstance(text, bytes) else text.encode()
        mask = os.urandom(4)
        size = bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + struct.pack(">H", len(data)) if len(data) < 65536 \
            else bytes([0x80 | 127]) + struct.pack(">Q", len(data))
        self.connection.sendall(bytes([0x80 | kind]) + size + mask + bytes(c ^ mask[i % 4] for i, c in enumerate(data)))

    def do(self, command):
        self.number += 1
        self.send(f"{self.number} {command}")

    def take(self, size):
        while len(self.octets) < size:
            part = self.connection.recv(1 << 16)
            if not part:
                raise EOFError
            self.octets += part
        data, self.octets = self.octets[:size], self.octets[size:]
        return data

    def receive(self):
        """One message into frames, rows, texts or closed."""
        first, size = self.take(2)
        size &= 0x7f
        if size > 125:
            size = struct.unpack(">H" if size == 126 else ">Q", self.take(2 if size == 126 else 8))[0]
        data = self.take(size)
        kind = first & 0x0f
        if kind == 2:
            self.frames.append((*FRAME.unpack(data[:FRAME.size]), data))
            if not self.slow:
                self.send("a")
        elif kind == 1:
            message = json.loads(data)
            (self.rows if message["kind"] == "rows" else self.texts).append(message)
        elif kind == 8:
            self.closed = (struct.unpack(">H", data[:2])[0], data[2:].decode())
        elif kind == 9:
            self.send(data, kind=10)

    def until(self, condition, what):
        """Receives until a condition holds."""
        end = time.monotonic() + 60 * runner.PATIENCE
        while not condition():
            runner.check(time.monotonic() < end, f"{what} does not come: {self.texts[-3:]}")
            try:
                self.receive()
            except EOFError:
                runner.check(condition(), f"{what}: the server has gone, {self.closed}")

    def step(self):
        """The last one that is known."""
        return max([frame[3] for frame in self.frames[-1:]] + [row["history"][-1][0] for row in self.rows[-1:] if row["history"]] + [0])

    def steps(self, count):
        """Waits for so many more."""
        goal = self.step() + count
        self.until(lambda: self.step() >= goal, f"step {goal}")

    def place(self, vertex):
        """Where a vertex is in the last frame."""
        frame = self.frames[-1]
        number, scale = list(self.rest).index(vertex), frame[5] / 32767
        moved = struct.unpack_from("<3h", frame[-1], len(frame[-1]) - 6 * len(self.rest) + 6 * number)
        return [x + scale * u for x, u in zip(self.rest[vertex], moved)]

    def go_by(self, command, vertex, way, more=""):
        """A command with a place: that of a vertex, and so far from there."""
        self.do(f"{command} {vertex} {' '.join(str(x + d) for x, d in zip(self.place(vertex), way))}{more}")

    def state(self):
        return [text for text in self.texts if text["kind"] == "state"][-1]

    def answer(self, kind):
        """Waits for the next text of a kind."""
        known = len(self.texts)
        self.until(lambda: any(text["kind"] == kind for text in self.texts[known:]), kind)
        return [text for text in self.texts[known:] if text["kind"] == kind][-1]

    def quit(self):
        self.do("quit")
        try:
            while True:
                self.receive()
        except (EOFError, OSError):
            pass
        self.connection.close()
