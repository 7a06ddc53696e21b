"""The page of a session in headless Chromium: a mouse pulls a bar, a finger on a phone does, a slider pushes a needle into skin.
What the page knows of the force is what live.prm computes once more; the body is drawn where it is."""

import json
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import chromium
import live_client
import runner

SMALL = runner.ROOT / "parameters" / "bar" / "small.prm"
NEEDLE = runner.ROOT / "parameters" / "contact" / "needle-skin.prm"
TIP = (2, 0, 2)  # the middle of the free end, where probe n28 is
WAY = (-24, -32)  # of the mouse, in pixels
MOVES = 8  # of the mouse, on its way
STEPS = 50
DIGITS = 15  # in tables

if not chromium.program():
    print("There is no Chromium.")
    raise SystemExit(77)  # told as skipped


def near(point):
    """The point, and others within a few pixels of it."""
    yield point["x"], point["y"]
    for radius in (2, 4, 6):
        for x, y in ((-1, 1), (-1, -1), (1, 1), (1, -1), (0, 1), (0, -1), (-1, 0), (1, 0)):
            yield point["x"] + radius * x, point["y"] + radius * y


def press_on(browser, vertex, press, let_go):
    """Presses beside a vertex where the body is hit at it."""
    for point in near(browser.evaluate(f"supple.screenOf({vertex})")):
        press(*point)
        if browser.evaluate("supple.grabbed()") == [vertex]:
            return point
        let_go(*point)
    raise RuntimeError(f"vertex {vertex} can't be hit")


def run_to(browser, step):
    """Runs to a step, or a few further, and pauses until the page knows all of that state."""
    browser.press(" ")
    browser.wait_for(f"supple.step() >= {step}", 60 * runner.PATIENCE)
    browser.press(" ")
    browser.wait_for("!supple.state().running && supple.state().step === supple.step()", 20 * runner.PATIENCE)
    browser.wait_for("supple.probes().step === supple.step()", 20 * runner.PATIENCE)
    browser.wait_for("supple.grabbed().length === 0 || supple.lastForce().step === supple.step()", 20 * runner.PATIENCE)
    time.sleep(0.2)  # it is drawn
    return browser.evaluate("supple.step()")


def check_drawn(browser, vertex, probe, where):
    """The vertex is drawn where a probe at it says."""
    row, rest = browser.evaluate("supple.probes()"), browser.evaluate(f"supple.restOf({vertex})")
    place = [x + row[f"{probe}.u{d}"] for x, d in zip(rest, "xyz")]
    drawn, right = browser.evaluate(f"supple.screenOf({vertex})"), browser.evaluate(f"supple.project({json.dumps(place)})")
    off = max(abs(drawn[d] - right[d]) for d in "xy")
    runner.check(off < 2, f"{where}: vertex {vertex} is drawn {off} pixels off its probe")


def check_fits(browser, where):
    width, content = browser.evaluate("[innerWidth, document.documentElement.scrollWidth]")
    runner.check(content <= width, f"{where}: {content} pixels of content on a screen of {width}")


def check_silent(browser, where):
    runner.check(not browser.complaints(), f"{where}: the console says {browser.complaints()}")


def end(browser, session):
    browser.evaluate("[...document.querySelectorAll('button')].find(b => b.textContent === 'End the session').click()")
    browser.wait_for("supple.state().status === 'ended'", 20 * runner.PATIENCE)
    runner.check(session.end() == 0, f"the session ends with {session.end()}")


def pull_by_mouse(browser):
    """Gives the vertex, and the force on it at a step."""
    browser.screen(1200, 900)
    vertex = browser.evaluate(f"supple.nearest({json.dumps(TIP)})")
    x, y = press_on(browser, vertex, lambda *at: browser.mouse("mousePressed", *at, True), lambda *at: browser.mouse("mouseReleased", *at, False))
    for move in range(1, MOVES + 1):
        browser.mouse("mouseMoved", x + WAY[0] * move / MOVES, y + WAY[1] * move / MOVES, True)
        time.sleep(0.02)
    step = run_to(browser, STEPS)
    force = browser.evaluate("supple.lastForce()")
    runner.check(force["vertex"] == vertex and force["step"] == step, f"at step {step} the page knows {force}")
    check_drawn(browser, vertex, "n28", "desktop")
    check_fits(browser, "desktop")
    browser.mouse("mouseReleased", x + WAY[0], y + WAY[1], False)
    browser.wait_for("supple.grabbed().length === 0")
    return vertex, step, force["force"]


def pull_by_finger(browser, vertex):
    browser.screen(390, 844, dark=True, phone=True, scale=2)
    time.sleep(0.5)
    browser.evaluate("document.querySelector('.stage').scrollIntoView({block: 'center'})")
    time.sleep(0.2)

    def touch(kind, *points):
        browser.send("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y} for x, y in points])

    x, y = press_on(browser, vertex, lambda *at: touch("touchStart", at), lambda *at: touch("touchEnd"))
    touch("touchMove", (x - 10, y - 20))
    step = run_to(browser, browser.evaluate("supple.step()") + 10)
    force = browser.evaluate("supple.lastForce()")
    runner.check(force["step"] == step and force["size"] > 0, f"phone, step {step}: the page knows {force}")
    check_drawn(browser, vertex, "n28", "phone")
    check_fits(browser, "phone")
    touch("touchEnd")
    browser.wait_for("supple.grabbed().length === 0")
    return step, force["force"]


def check_repeated(session, vertex, forces):
    """live.prm computes what the page has told."""
    folder = session.folder + "/again"
    status, _, error = runner.run(session.folder + "/live.prm", "--quiet", "--output", folder)
    runner.check(status == 0, f"live.prm ends with {status}: {error}")
    rows = {row["step"]: row for row in runner.Results(folder).table("hands.csv") if row["vertex"] == vertex}
    for step, force in forces:
        told, computed = [[float(f"{x:.{DIGITS}g}") for x in vector] for vector in (force, [rows[step][f"f{d}"] for d in "xyz"])]
        runner.check(told == computed, f"step {step}: the page told a force of {told}, live.prm computes {computed}")


def push_needle(browser):
    """By its slider, further and further."""
    browser.screen(1200, 900)
    browser.press(" ")
    depths = []
    for part in (0.04, 0.07, 0.1):
        browser.evaluate(f"(() => {{ const slider = document.querySelector('.tool input'); slider.value = {part}; slider.dispatchEvent(new Event('input')); }})()")
        wanted = browser.evaluate("supple.wanted('needle')")
        browser.wait_for(f"Math.abs(supple.tool('needle').y - {wanted[1]}) < 1e-9", 60 * runner.PATIENCE)
        depths.append(browser.evaluate("supple.tool('needle')"))
    browser.press(" ")
    runner.check(depths[0]["y"] > depths[1]["y"] > depths[2]["y"], f"the slider moves the needle to {[row['y'] for row in depths]}")
    forces = [-row["fy"] for row in depths]
    runner.check(0 < forces[0] < forces[1] < forces[2], f"the force does not grow with the depth: {forces}")
    # Its curve is beside the body, without a scroll.
    title = "[...document.querySelectorAll('.curves h3')].find((title) => title.textContent.startsWith('Force of needle in mN, against'))"
    browser.wait_for(f"scrollY === 0 && {title}?.parentElement.getBoundingClientRect().bottom < innerHeight", 20 * runner.PATIENCE)
    check_fits(browser, "needle")


with chromium.Chromium() as browser:
    with live_client.Session(SMALL, {"Time/Step": 0.02}) as session:
        browser.visit(session.address)
        browser.wait_for("supple.state().session !== undefined")
        vertex, *pulled = pull_by_mouse(browser)
        forces = [pulled, pull_by_finger(browser, vertex)]
        check_silent(browser, "bar")
        end(browser, session)
    check_repeated(session, vertex, forces)
    with live_client.Session(NEEDLE, {"Mesh/Box cubes": "8, 6, 8"}) as session:
        browser.visit(session.address)
        browser.wait_for("supple.state().session !== undefined")
        push_needle(browser)
        check_silent(browser, "needle")
        end(browser, session)
