"""A page that hardly answers does not hold up the session, and nothing piles up for it."""

import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import live_client
import runner

BAR = runner.ROOT / "parameters" / "bar" / "large.prm"
SECONDS = 8

with live_client.Session(BAR, {"Time/Step": 0.01, "Output/History": "false", "Output/Frames": "none"}) as session:
    page = live_client.Page(session, slow=True)
    page.do("speed 0")
    page.do("run")
    page.steps(20)
    before, steps_before = session.memory(), page.step()
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        time.sleep(1)
        page.send("a")
    # It reads nothing in the meantime: what comes now was in the pipes, and the newest frame is not far behind.
    page.slow = False
    page.send("a")
    known = len(page.frames)
    page.until(lambda: len(page.frames) > known + SECONDS + 4, "frames after the pause")
    after = session.memory()
    runner.check(after - before < 5, f"in {SECONDS} s the program has grown from {before} to {after} MB")
    page.do("pause")
    page.until(lambda: not page.state()["running"], "the pause")
    last = page.state()["step"]
    page.until(lambda: page.frames[-1][3] == last, f"a frame of step {last}")
    runner.check(last > steps_before + 20, f"while the page slept the session went from step {steps_before} to {last}")

    # A page that goes without a word: the session goes on, and the next one finds it.
    page.do("run")
    page.steps(2)
    page.connection.close()
    time.sleep(0.5)
    for _ in range(50):
        if session.ask(session.upgrade_lines()).startswith("HTTP/1.1 101"):
            break
        time.sleep(0.1)
    time.sleep(0.5)
    page = live_client.Page(session)
    page.until(lambda: page.texts, "the state")
    runner.check(page.state()["running"] and page.state()["step"] > last, f"the next page finds {page.state()}")
    page.quit()
    runner.check(session.end() == 0, f"the session ends with {session.end()}")
