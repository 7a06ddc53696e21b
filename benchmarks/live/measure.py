"""How quickly a live session answers, at several sizes of the bar: frames/s, milliseconds from a command to the frame that
knows of it, steps/s, and what the program's threads take of a core.

    scripts/run.sh --version && python3 benchmarks/live/measure.py build/supple [--sizes 1 2 4 8] [--seconds 6] [--pages python chromium]
    python3 benchmarks/live/measure.py build/supple --memory 10

The small bar with steps of 1/60 s, pulled at its tip by a hand that moves ten times a second. Once with a page in Python, which
draws nothing, once with the real one in headless Chromium, which draws by the processor (SwiftShader). --memory: minutes with a
page that is ready for one frame a second. The tables go into README.md of this folder by hand.
"""

import argparse
import math
import os
import pathlib
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import chromium
import live_client

BAR = ROOT / "parameters" / "bar" / "small.prm"
TIP = (2, 0, 2)
PAUSE = 0.1  # s between two commands
TICK = os.sysconf("SC_CLK_TCK")


def settings(size, threads=1):
    return {"Mesh/Box cubes": f"{2 * size}, {8 * size}, {2 * size}", "Time/Step": 1 / 60, "Start/Velocity": "0; 0; 0",
            "Solver/Threads": threads, "Output/Frames": "none", "Output/History": "false", "Probes/Points": "", "Probes/Boundaries": ""}


def seconds_of_threads(process):
    """CPU seconds of the thread that computes, and of all others."""
    spent = {}
    for task in pathlib.Path(f"/proc/{process}/task").iterdir():
        fields = (task / "stat").read_text().rsplit(")", 1)[1].split()
        spent[int(task.name)] = (int(fields[11]) + int(fields[12])) / TICK
    computing = spent.pop(process)
    return computing, sum(spent.values())


def path(place, beat):
    """Where the hand is: around a circle."""
    return [place[0] + 0.5 * math.cos(beat), place[1], place[2] + 0.5 * math.sin(beat)]


class PythonPage:
    """Draws nothing."""

    name = "Python"

    def __init__(self, session):
        self.page = live_client.Page(session)
        self.page.until(lambda: self.page.frames, "a frame")
        self.tip = min(self.page.rest, key=lambda v: math.dist(self.page.rest[v], TIP))
        self.place = self.page.rest[self.tip]
        self.count = 0

    def receive(self):
        self.page.receive()
        self.count += len(self.page.frames)
        self.newest = self.page.frames[-1] if self.page.frames else self.newest
        for list_ in (self.page.frames, self.page.rows, self.page.texts):
            list_.clear()

    newest = None

    def do(self, command):
        self.page.do(command)

    def timed(self, command):
        begin = time.monotonic()
        self.page.do(command)
        while True:
            self.receive()
            if self.newest and self.newest[4] >= self.page.number:
                return 1e3 * (time.monotonic() - begin), None

    def wait(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.receive()

    def frames(self):
        return self.count

    def step_and_time(self):
        return self.newest[3], self.newest[2]

    def quit(self):
        self.page.quit()


class ChromiumPage:
    """The real one, on a screen of 1280 x 900."""

    name = "Chromium"

    def __init__(self, session):
        self.browser = chromium.Chromium()
        self.browser.screen(1280, 900)
        self.browser.visit(session.address)
        self.browser.wait_for("supple.state().session !== undefined && supple.frames() > 0")
        self.tip = self.browser.evaluate(f"supple.nearest({list(TIP)})")
        self.place = self.browser.evaluate(f"supple.restOf({self.tip})")

    def do(self, command):
        self.timed(command)

    def timed(self, command):
        return self.browser.evaluate(f"supple.timed('{command}')")

    def wait(self, seconds):
        time.sleep(seconds)

    def frames(self):
        return self.browser.evaluate("supple.frames()")

    def step_and_time(self):
        return self.browser.evaluate("[supple.step(), supple.time()]")

    def quit(self):
        self.browser.__exit__()


def middle_and_most(values):
    """Median / 95 %."""
    values = sorted(values)
    return f"{statistics.median(values):.0f} / {values[math.ceil(0.95 * len(values)) - 1]:.0f}"


def measured(program_page, size, seconds, threads):
    """A line of the table."""
    with live_client.Session(BAR, settings(size, threads)) as session:
        page = program_page(session)
        page.do("run")
        page.do(f"grab {page.tip} {' '.join(map(str, page.place))} 0 0")
        page.wait(1)
        arrived, shown, beat = [], [], 0
        begin, frames = time.monotonic(), page.frames()
        (step, moment), spent = page.step_and_time(), seconds_of_threads(session.process.pid)
        while time.monotonic() < begin + seconds:
            beat += 0.2
            before = time.monotonic()
            first, second = page.timed(f"move {page.tip} {' '.join(map(str, path(page.place, beat)))}")
            arrived.append(first)
            shown.append(second)
            page.wait(max(0, PAUSE * (0.5 + (7 * len(arrived)) % 10 / 10) - (time.monotonic() - before)))
        wall = time.monotonic() - begin
        rate, real_time = (page.frames() - frames) / wall, (page.step_and_time()[1] - moment) / wall
        shares = [100 * (after - before) / wall for before, after in zip(spent, seconds_of_threads(session.process.pid))]
        page.do("speed 0")
        page.wait(0.5)
        step, begin = page.step_and_time()[0], time.monotonic()
        page.wait(seconds / 2)
        steps = (page.step_and_time()[0] - step) / (time.monotonic() - begin)
        page.do("pause")
        memory = session.memory()
        surface = 2 * (2 * size + 1)**2 + 8 * size * (8 * size - 1)  # vertices
        page.quit()
        session.process.terminate()
        session.end()
    drawn = middle_and_most(shown) if shown[0] is not None else "-"
    return (f"| {192 * size**3} | {surface} | {page.name} | {rate:.1f} | {middle_and_most(arrived)} | {drawn} | {real_time:.2f} | {steps:.0f} | "
            f"{shares[0]:.0f} % | {shares[1]:.1f} % | {memory:.0f} |")


def grown(minutes):
    """Memory each minute, with a page that is ready for one frame a second."""
    with live_client.Session(BAR, settings(4)) as session:
        page = live_client.Page(session, slow=True)
        page.do("run")
        page.connection.settimeout(0.05)
        begin = time.monotonic()
        for second in range(60 * minutes + 1):
            while time.monotonic() < begin + second:
                try:
                    page.receive()
                    for list_ in (page.frames, page.rows, page.texts):
                        del list_[:-1]
                except TimeoutError:
                    time.sleep(0.01)
            page.send("a")
            if second % 60 == 0:
                print(f"minute {second // 60}: {session.memory():.1f} MB, step {page.step()}", flush=True)
        session.process.terminate()
        session.end()


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("program")
    options.add_argument("--sizes", type=int, nargs="+", default=[1, 2, 4, 8])
    options.add_argument("--seconds", type=float, default=6)
    options.add_argument("--threads", type=int, default=1, help="that compute")
    options.add_argument("--pages", nargs="+", choices=["python", "chromium"], default=["python", "chromium"])
    options.add_argument("--memory", type=int, metavar="MINUTES")
    options = options.parse_args()
    print(f"load of the machine: {pathlib.Path('/proc/loadavg').read_text().strip()}", flush=True)
    if options.memory:
        grown(options.memory)
        return
    print("| tetrahedra | vertices drawn | page | frames/s | ms to arrive | ms to be seen | of real time | steps/s | computes | serves | MB |\n|" + "---|" * 11)
    for name in options.pages:
        for size in options.sizes:
            print(measured({"python": PythonPage, "chromium": ChromiumPage}[name], size, options.seconds, options.threads), flush=True)
    print(f"load of the machine: {pathlib.Path('/proc/loadavg').read_text().strip()}")


main()
