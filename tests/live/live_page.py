"""Works with the page of a live session in headless Chromium: live_page.py ADDRESS --at X Y Z [--probe NAME]. Presses on the
vertex that is nearest to a place at rest, moves the mouse, lets the session make some steps, pauses it, and prints as JSON
what the page knows then: step, time, the force of the hand, the vertex and where it is drawn, where the probe that follows
it would be, and what the console complains of. Nothing of it is judged here."""

import argparse
import base64
import json
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import chromium

MOVES = 8  # of the mouse, on its way


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("address", help="as supple --live prints it, with its token")
    parser.add_argument("--at", type=float, nargs=3, required=True, metavar=("X", "Y", "Z"), help="place at rest, in metres")
    parser.add_argument("--probe", help="name of a probe that follows this vertex")
    parser.add_argument("--way", type=float, nargs=2, default=(-24, -32), help="of the mouse, in pixels")
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--picture", type=pathlib.Path, help="a .png of the page, with the hand on the body")
    parser.add_argument("--end", action="store_true", help="ends the session")
    return parser.parse_args()


def inward(browser, vertex, start):
    """A point of the screen beside the vertex on which the body is hit there: within a few pixels towards the body."""
    for radius in (0, 2, 4, 6):
        for x, y in ((0, 0), (-1, 1), (-1, -1), (1, 1), (1, -1), (0, 1), (0, -1), (-1, 0), (1, 0)):
            point = (start["x"] + radius * x, start["y"] + radius * y)
            browser.mouse("mousePressed", *point, True)
            if browser.evaluate("supple.grabbed()") == [vertex]:
                return point
            browser.mouse("mouseReleased", *point, False)
    raise SystemExit(f"The mouse does not hit vertex {vertex}.")


def pull(browser, options):
    """Grabs the vertex of the paused body, moves it, and runs on."""
    vertex = browser.evaluate(f"supple.nearest({json.dumps(options.at)})")
    x, y = inward(browser, vertex, browser.evaluate(f"supple.screenOf({vertex})"))
    for move in range(1, MOVES + 1):
        browser.mouse("mouseMoved", x + options.way[0] * move / MOVES, y + options.way[1] * move / MOVES, True)
        time.sleep(0.03)
    begun = browser.evaluate("supple.step()")
    browser.press(" ")
    browser.wait_for(f"supple.step() >= {begun + options.steps}", 120)
    browser.press(" ")
    browser.wait_for("!supple.state().running && supple.state().step === supple.step()", 60)
    browser.wait_for("!supple.probes().step || supple.probes().step === supple.step()", 10)
    time.sleep(0.2)
    return vertex


def seen(browser, options, vertex):
    what = browser.evaluate(f"({{step: supple.step(), time: supple.time(), vertex: {vertex}, force: supple.lastForce(), "
                            f"drawn: supple.screenOf({vertex}), rest: supple.restOf({vertex})}})")
    if options.probe:
        row = browser.evaluate("supple.probes()")
        place = [x + row[f"{options.probe}.u{d}"] for x, d in zip(what["rest"], "xyz")]
        what["probe"] = browser.evaluate(f"supple.project({json.dumps(place)})")
        what["probe_step"] = row["step"]
    return what


def main():
    options = arguments()
    if not chromium.program():
        print("There is no Chromium.")
        raise SystemExit(77)  # told as skipped
    with chromium.Chromium() as browser:
        browser.screen(1200, 900)
        browser.visit(options.address)
        browser.wait_for("supple.state().session !== undefined")
        vertex = pull(browser, options)
        what = seen(browser, options, vertex)
        if options.picture:
            options.picture.write_bytes(base64.b64decode(browser.send("Page.captureScreenshot", format="png")["data"]))
        browser.send("Input.dispatchMouseEvent", type="mouseReleased", x=0, y=0, button="left", buttons=0, clickCount=1)
        browser.wait_for("supple.grabbed().length === 0", 10)
        what["complaints"] = browser.complaints()
        if options.end:
            browser.evaluate("[...document.querySelectorAll('button')].find(b => b.textContent === 'End the session').click()")
            browser.wait_for("supple.state().status === 'ended'", 60)
    print(json.dumps(what))


main()
