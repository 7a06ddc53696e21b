"""The report page: its numbers are those of the run, whatever became of it, and it works in a browser (headless Chromium;
where there is none, only the numbers are looked at)."""

import base64
import json
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import chromium
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
PUSHED = {"Start/Velocity": "0; 0; -40", "Time/Steps": 60, "Solver/Tolerance": 1e-12}


FIELDS = ["volume_ratio", "von_mises_stress", "contact_pressure", "error_in_space"]


class Page:
    """The data of a page, unpacked as the page itself does it."""

    def __init__(self, results):
        self.file = results.folder / "report.html"
        text = self.file.read_text()
        runner.check(len(text) < 10e6, f"{len(text)} bytes")
        runner.check(not re.search(r"(?:src|href)=[\"']?(?:https?:)?//", text), "the page loads something")
        self.data = json.loads(re.search(r'id="data">(.*?)</script>', text, re.S)[1])
        if "surface" not in self.data:
            return
        surface = self.data["surface"]
        packed = base64.b64decode(re.search(r'id="surface">(.*?)</script>', text, re.S)[1])
        n, m = surface["vertices"], surface["triangles"]
        self.rest = self.triples(struct.unpack_from(f"<{3 * n}f", packed))
        self.triangles = self.triples(struct.unpack_from(f"<{3 * m}I", packed, 12 * n))
        length = 3 * n + sum(field in surface for field in FIELDS) * m
        begin = 12 * n + 12 * m + 4 * ((m + 1) // 2)
        unpacked = zlib.decompress(packed[begin:])
        runner.check(len(unpacked) == 2 * length * len(surface["times"]), f"{len(unpacked)} bytes of frames")
        unit = surface["largest_displacement"] / 32767
        low, high = surface["volume_ratio"]
        self.frames, values = [], [0] * length
        for at in range(0, len(unpacked), 2 * length):
            folded = [a + 256 * b for a, b in zip(unpacked[at:at + length], unpacked[at + length:at + 2 * length])]
            values = [(value + (f >> 1 ^ -(f & 1))) % 65536 for value, f in zip(values, folded)]
            u = [unit * (value - 65536 * (value >= 32768)) for value in values[:3 * n]]
            ratios = [low + (high - low) * value / 65535 for value in values[3 * n:3 * n + m]]
            self.frames.append((self.triples(u), ratios))
        if "contact_pressure" in surface:  # in the last frame, of the triangles
            low, high = surface["contact_pressure"]
            self.pressures = [low + (high - low) * value / 65535 for value in values[3 * n + 2 * m:3 * n + 3 * m]]

    @staticmethod
    def triples(values):
        return list(zip(*[iter(values)] * 3))

    def vertex(self, place):
        return min(range(len(self.rest)), key=lambda v: sum((a - b)**2 for a, b in zip(self.rest[v], place)))


def area(page, u):
    """Twice the surface's area vector, and six times the volume in it: zero and positive if it is closed and points outward."""
    total, volume = [0, 0, 0], 0
    for corners in page.triangles:
        a, b, c = ([x + d for x, d in zip(page.rest[v], u[v])] for v in corners)
        p, q = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        total = [s + n for s, n in zip(total, normal)]
        volume += sum(x * n for x, n in zip(a, normal))
    return total, volume


# What is drawn is what was computed: the surface is closed, its vertices are where the probes say.
bar = runner.simulate(runner.BAR, PUSHED)
page = Page(bar)
surface, summary = page.data["surface"], bar.summary()
runner.check(page.data["name"] == "bar/large" and page.data["summary"] == summary, "name and summary")
runner.check(surface["triangles"] == 2 * (2 * 2 * 2 + 4 * 2 * 8) and surface["vertices"] == surface["triangles"] // 2 + 2, "sizes")
runner.check(len(surface["times"]) == len(bar.frame_times()) == surface["frames_written"], "frames")
total, volume = area(page, [(0, 0, 0)] * len(page.rest))
runner.check(max(map(abs, total)) < 1e-9 and abs(volume / 6 - summary["volume"] / 1) < 1e-6, f"surface: {total}, {volume / 6}")
tip, unit = page.vertex((2, 0, 2)), surface["largest_displacement"] / 32767
rows = {round(row["time"], 9): row for row in bar.probes()}
for when, (u, ratios) in zip(surface["times"], page.frames):
    row = rows[round(when, 9)]
    miss = max(abs(u[tip][d] - row[f"n28.u{axis}"]) for d, axis in enumerate("xyz"))
    runner.check(miss < 1.01 * unit, f"at {when} the vertex is {miss} m off")
    runner.check(max(map(abs, area(page, u)[0])) < 1e-6, "the deformed surface is not closed")
    runner.check(min(ratios) > summary["extremes"]["min_volume_ratio"] - 1e-4, "volume ratios")
history = page.data["tables"]["history"]
runner.check(history["rows"] == history["shown"] == 61 and history["columns"]["kinetic"][7] is not None, "history")
for row, time_shown, kinetic in zip(bar.history(), history["columns"]["time"], history["columns"]["kinetic"]):
    runner.check(abs(row["time"] - time_shown) < 1e-6 and abs(row["kinetic"] - kinetic) <= 1e-6 * row["kinetic"], f"{row}")
runner.check(not (bar.folder / "report.frames").exists(), "what the report is made of is left")

two = Page(runner.simulate(runner.BAR, PUSHED, ranks=2))
runner.check(two.rest == page.rest and two.triangles == page.triangles, "two processes: another surface")
for (u, _), (v, _) in zip(page.frames, two.frames):
    worst = max(abs(a - b) for p, q in zip(u, v) for a, b in zip(p, q))
    runner.check(worst < 2.01 * unit, f"two processes: {worst} m")

# The errors in space of the frames, where they are asked for: none at the start, which has no strain.
erring = Page(runner.simulate(runner.BAR, {**PUSHED, "Space/Estimate error": "frames"}))
runner.check([u for u, _ in erring.frames] == [u for u, _ in page.frames], "with errors in space: another motion")
low, high = erring.data["surface"]["error_in_space"]
runner.check(low == 0 and 1 < high < 10 and "error_in_space" not in surface, f"errors in space of {low} to {high}")
told = [when for when, error in zip(*(erring.data["tables"]["history"]["columns"][name] for name in ("time", "space_error"))) if error is not None]
runner.check(told == [round(time, 9) for time in erring.data["surface"]["times"][1:]], f"errors in space at {told}")

# The pressure of contact, where there is any: of a block on an incline, its weight over the face that touches; on two processes too.
pages = [Page(runner.simulate(runner.ROOT / "parameters" / "contact" / "incline.prm", {"Time/Steps": 20, "Solver/Tolerance": 1e-10}, ranks=ranks))
         for ranks in (1, 2)]
for touching in pages:
    runner.check("contact_pressure" in touching.data["surface"] and "error_in_space" not in touching.data["surface"], "no pressure of contact")
    below = [p for triangle, p in zip(touching.triangles, touching.pressures) if all(abs(touching.rest[v][2]) < 1e-9 for v in triangle)]
    others = [p for triangle, p in zip(touching.triangles, touching.pressures) if all(touching.rest[v][2] > 1e-9 for v in triangle)]
    runner.check(len(below) == 18 and abs(sum(below) / 18 / 910.8 - 1) < 0.1 and max(others) == 0, f"pressures of {below} Pa")
worst = max(abs(a - b) for a, b in zip(*(page.pressures for page in pages)))
runner.check(worst < 1e-3 * max(pages[0].pressures), f"two processes: pressures differ by {worst} Pa")
runner.check("contact_pressure" not in page.data["surface"], "pressures of nothing")

# Long histories are thinned, but not their extremes.
long = runner.simulate(runner.BAR, {"Time/Steps": 5000, "Time/Step": 0.0014, "Corotation/Rotation": "none",
                                    "Output/Motion": 0.5, "Output/Volume ratio change": 10})
table = Page(long).data["tables"]["history"]
runner.check(table["rows"] == 5001 and table["shown"] < 2200, f"{table['rows']} rows, {table['shown']} shown")
for column in ("kinetic", "max_volume_ratio"):
    worst = max(row[column] for row in long.history())
    runner.check(abs(max(table["columns"][column]) - worst) <= 1e-6 * worst, f"{column}: the largest is lost")

none = runner.simulate(runner.BAR, {"Output/Report": "false", "Time/Steps": 2})
runner.check(not (none.folder / "report.html").exists() and not (none.folder / "report.frames").exists(), "a report nobody wants")
curves = runner.simulate(runner.BAR, {"Output/Frames": "none", "Time/Steps": 2})
runner.check("surface" not in Page(curves).data, "a body without frames")
still = runner.simulate(runner.BAR, {"Output/History": "false", "Time/Steps": 2})
runner.check(Page(still).data["tables"] == {}, "tables without a history")

# A plane body: its triangles are its cells.
plane = runner.simulate(runner.ROOT / "parameters" / "skin" / "needle-axisymmetric.prm", {"Time/Steps": 3})
flat = Page(plane)
runner.check(flat.data["surface"]["triangles"] == plane.summary()["cells"] and flat.data["static"], "plane body")
runner.check(flat.data["surface"]["materials"] == [0, 1] and "profile_skin" in flat.data["tables"], "materials, profile")

# Failed.
failed = runner.Results(folder / "failed")
status, _, error = runner.run(runner.BAR, "--quiet", "--output", failed.folder, "--set", "Loads/Body force=if(t > 1, 1/0, 0); 0; 0",
                              "--set", "Time/Retries=0")
runner.check(status == 2 and Page(failed).data["summary"]["status"].startswith("failed: Step"), error)

# Interrupted on one process and gone on with on two: the page has all frames.
settings = {**PUSHED, "Time/Steps": 1000, "Output/Frames": "interval", "Output/Interval": 3.5,
            "Checkpoint/Every": 10, "Checkpoint/Resume": "auto"}
stopped = runner.Results(folder / "stopped")
arguments = ["--quiet", "--output", str(stopped.folder), *runner.overrides(settings)]
process = subprocess.Popen([runner.SUPPLE, str(runner.BAR), *arguments], env=runner.ENVIRONMENT, stderr=subprocess.DEVNULL)
while process.poll() is None and not (stopped.folder / "solution" / "frame_0003.vtu").exists():
    time.sleep(0.01)
process.send_signal(signal.SIGTERM)
runner.check(process.wait() == 2, "it was not stopped")
early = Page(stopped)
runner.check(early.data["summary"]["status"] == "interrupted" and len(early.frames) > 3, "the report of an interrupted run")
interrupted = folder / "interrupted.html"
interrupted.write_bytes(early.file.read_bytes())
status, _, error = runner.run(runner.BAR, *arguments, ranks=2)
runner.check(status == 0, error)
whole = Page(stopped)
times = stopped.frame_times()
runner.check(len(whole.frames) == len(times) and all(abs(a - b) < 1e-9 for a, b in zip(times, whole.data["surface"]["times"])),
             f"a resumed run shows {len(whole.frames)} of {len(times)} frames")
runner.check(whole.data["tables"]["history"]["rows"] == 1001, "a resumed run's history")
worst = max(abs(a - b) for p, q in zip(early.frames[1][0], whole.frames[1][0]) for a, b in zip(p, q))
runner.check(worst < 1e-4, f"a frame from before differs by {worst} m")

# Where those before are lost it begins there.
(stopped.folder / "report.frames").unlink()


def longer(steps):
    """The same run with more steps."""
    return [f"Time/Steps={steps}" if word.startswith("Time/Steps=") else word for word in arguments]


status, _, error = runner.run(runner.BAR, *longer(1200))
late = Page(stopped)
runner.check(status == 0 and late.data["surface"]["times"][0] > 60 and late.data["tables"]["history"]["rows"] == 1201, error)

# And goes on from there, not from what it has lost.
status, _, error = runner.run(runner.BAR, *longer(1400))
again = Page(stopped).data["surface"]["times"]
runner.check(status == 0 and again[:len(late.frames) - 1] == late.data["surface"]["times"][:-1] and len(again) > len(late.frames),
             f"{len(again)} frames from {again[0]} on")

# A study.
study = folder / "study.prm"
study.write_text("\n".join(["subsection Study", f"  set Scene = {runner.BAR}", "  set Overrides = Time/Steps = 4", "  set Repeats = 0",
                            "  set Methods = backward euler: steps 0.07, 0.035; trbdf2: steps 0.07, 0.035, 0.014",
                            "  set Reference = esdirk4: step 0.0035", "end", ""]))
status, _, error = runner.run(study, "--quiet", "--output", folder / "study")
runner.check(status == 0, error)
table = Page(runner.Results(folder / "study")).data
runner.check(table["kind"] == "study" and len(table["rows"]) == 5 and all(row["error"] > 0 for row in table["rows"]), f"{table}")
runner.check(not list((folder / "study").glob("runs/*/report.html")), "each run of a study has a report")

# Cells that turn inside out.
beaten = runner.simulate(runner.BAR, {"Start/Velocity": "0; 0; -400", "Time/Steps": 5})
runner.check(beaten.summary()["extremes"]["most_inverted"] > 0, "no cell is inside out")

# An identification: a page of all its pairs and the best surfaces.
status, _, error = runner.run(runner.ROOT / "parameters" / "skin" / "tables-3.3.prm", "--quiet", "--output", folder / "identification",
                              "--set", "Identification/Thicknesses=0.75, 1.5", "--set", "Identification/Elasticity ratios=3, 7, 15")
runner.check(status == 0, error)
fitted = runner.Results(folder / "identification")
skin = Page(fitted).data
runner.check(skin["kind"] == "identification" and skin["csv"] == (fitted.folder / "identification.csv").read_text(), "pairs")
surfaces = fitted.table("profiles.csv")
shown = [(profile["set"], distance, measured, computed) for profile in skin["profiles"]
         for distance, measured, computed in zip(profile["distances"], profile["measured"], *profile["computed"].values())]
runner.check(len(shown) == len(surfaces) > 10, f"{len(shown)} of {len(surfaces)} points")
for row, point in zip(surfaces, shown):
    runner.check(all(abs(a - b) <= 1e-6 * abs(a) for a, b in zip(row.values(), point)), f"{row} is shown as {point}")

if not chromium.program():
    print("There is no Chromium: pages were not opened.")
    raise SystemExit(77)  # told as skipped

# How many colours the body has, beside that of the background.
COLOURS = """(() => {
  const source = document.querySelector('.stage canvas'), canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [200, 150];
  const context = canvas.getContext('2d');
  context.drawImage(source, 0, 0, 200, 150);
  const found = {};
  const pixels = context.getImageData(0, 0, 200, 150).data;
  for (let i = 0; i < pixels.length; i += 4) {
    const name = pixels.slice(i, i + 3).join();
    found[name] = (found[name] || 0) + 1;
  }
  const counts = Object.values(found);
  const hash = pixels.reduce((sum, value, i) => (sum * 31 + value) % 1000003, 7);
  return {colours: counts.length, body: 1 - Math.max(...counts) / (200 * 150), hash};
})()"""
LABEL = "document.querySelector('.time').textContent"
SMALL = "[...document.querySelectorAll('button, select, summary')].filter(e => e.offsetParent && e.getBoundingClientRect().height < %d).length"


def settled(browser):
    """What is on the canvas when nothing changes any more."""
    browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return browser.evaluate(COLOURS)


def opens(browser, file, what, **screen):
    browser.screen(**screen)
    browser.open(file)
    width = screen["width"]
    runner.check(browser.evaluate("document.documentElement.scrollWidth") <= width, f"{what}: wider than {width}")
    runner.check(browser.complaints() == [], f"{what}: {browser.complaints()}")


DESKTOP = dict(width=1400, height=900)
with chromium.Chromium() as browser:
    opens(browser, page.file, "bar", **DESKTOP)
    seen = settled(browser)
    runner.check(seen["colours"] > 30 and 0.05 < seen["body"] < 0.95, f"the picture of the bar: {seen}")
    runner.check(browser.evaluate("document.querySelectorAll('.chart canvas').length") >= 4, "curves")
    runner.check("192 cells" in browser.evaluate("document.querySelector('header').textContent"), "header")
    runner.check(browser.evaluate("document.querySelectorAll('.parameters dt').length") > 40, "parameters")

    # Keys: to the start, a frame on, play, pause. The line in the curves and their legends go along.
    line = "document.querySelector('.player-line').style.transform + document.querySelector('.u-legend').textContent"
    browser.press("Home")
    start, at_start, line_at_start = browser.evaluate(LABEL), settled(browser), browser.evaluate(line)
    runner.check(start.startswith("0.000") and "1/" in start, start)
    browser.press("ArrowRight")
    runner.check("2/" in browser.evaluate(LABEL) and settled(browser)["hash"] != at_start["hash"], "next frame")
    runner.check(browser.evaluate(line) != line_at_start, "the curves do not follow the player")
    browser.press("Home")
    browser.press(" ")
    browser.wait_for(f"{LABEL} !== {json.dumps(start)} && !/ 1\\//.test({LABEL})")
    browser.press(" ")
    stopped_at = browser.evaluate(LABEL)
    time.sleep(0.5)
    runner.check(browser.evaluate(LABEL) == stopped_at, "it plays on after a pause")
    browser.press("End")
    runner.check(f"{len(page.frames)}/{len(page.frames)}" in browser.evaluate(LABEL), "end")

    # Colours, edges, body at rest, enlargement: each changes the picture.
    for change in ["document.querySelectorAll('.controls select')[0].selectedIndex = 1", "document.querySelectorAll('.controls select')[2].selectedIndex = 2"]:
        before = settled(browser)["hash"]
        browser.evaluate(change + "; document.querySelectorAll('.controls select').forEach(s => s.dispatchEvent(new Event('change')))")
        runner.check(settled(browser)["hash"] != before, f"nothing happens: {change}")
    for key in "wg":
        before = settled(browser)["hash"]
        browser.press(key)
        runner.check(settled(browser)["hash"] != before, f"nothing happens: {key}")
    browser.evaluate("document.querySelector('.stage canvas').focus()")
    before = settled(browser)["hash"]
    browser.press("ArrowLeft")
    runner.check(settled(browser)["hash"] != before, "arrows do not turn the body")
    runner.check(browser.complaints() == [], f"bar: {browser.complaints()}")

    opens(browser, page.file, "phone", width=390, height=844, phone=True)
    runner.check(settled(browser)["body"] > 0.05 and browser.evaluate(SMALL % 32) == 0, "phone: the body, or small controls")

    opens(browser, erring.file, "errors in space", **DESKTOP)
    before = settled(browser)["hash"]
    browser.evaluate("(s => { s.value = 'error_in_space'; s.dispatchEvent(new Event('change')); })(document.querySelector('.controls select'))")
    runner.check(settled(browser)["hash"] != before, "the body has no colours of its errors in space")
    runner.check("of a swing" in browser.evaluate("document.querySelector('.summary').textContent"), "the summary tells no error in space")

    opens(browser, pages[0].file, "pressure of contact", **DESKTOP)
    before = settled(browser)["hash"]
    browser.evaluate("(s => { s.value = 'contact_pressure'; s.dispatchEvent(new Event('change')); })(document.querySelector('.controls select'))")
    runner.check(settled(browser)["hash"] != before, "the body has no colours of its pressure of contact")

    opens(browser, flat.file, "dark", **DESKTOP, dark=True)
    background = [int(c) for c in re.findall(r"\d+", browser.evaluate("getComputedStyle(document.body).backgroundColor"))]
    runner.check(max(background[:3]) < 60 and settled(browser)["colours"] > 30, f"dark: {background}")

    SMALLER = dict(width=1000, height=600)
    for file, word in [(failed.folder / "report.html", "1/0"), (interrupted, "Interrupted")]:
        opens(browser, file, word, **SMALLER)
        told = browser.evaluate("document.querySelector('.notice')?.textContent ?? ''")
        runner.check(word in told or "failed" in told, f"the reason is not on top: {told}")
        if word == "1/0":
            n = len(Page(failed).frames)
            runner.check(f"{n}/{n}" in browser.evaluate(LABEL), "a failed run does not open at its end")
    opens(browser, curves.folder / "report.html", "without frames", **SMALLER)
    opens(browser, still.folder / "report.html", "without history", **SMALLER)
    opens(browser, late.file, "from a later instant on", **SMALLER)
    runner.check("gone on with" in browser.evaluate("document.querySelector('.about').textContent"), "the page does not say where it begins")

    opens(browser, beaten.folder / "report.html", "inverted", **SMALLER)
    told = browser.evaluate("document.querySelector('.notice.warn')?.textContent ?? ''")
    runner.check("inside out" in told or "inverted" in told, f"cells inside out are not on top: {told}")

    opens(browser, folder / "study" / "report.html", "study", **SMALLER)
    runner.check(browser.evaluate("document.querySelectorAll('.chart canvas').length") == 2, "the plots of a study")
    runner.check(browser.evaluate("document.querySelectorAll('.study tbody tr').length") == 5, "the table of a study")

    opens(browser, folder / "identification" / "report.html", "identification", **SMALLER)
    errors = {(row["thickness"], row["ratio"]): row for row in fitted.table("identification.csv")}
    for kind, column in [("root_of_squares", "root_of_squares"), ("error_1", "error_1")]:
        browser.evaluate(f"(s => {{ s.value = '{kind}'; s.dispatchEvent(new Event('change')); }})(document.querySelector('.heat-map select'))")
        best = min(errors.values(), key=lambda row: row[column])
        told = browser.evaluate("document.querySelector('.heat td.best').title")
        runner.check(told.startswith(f"{best['thickness']:g} mm and {best['ratio']:g}: "), f"the framed pair is {told}, not {best}")
        runner.check(browser.evaluate("document.querySelectorAll('.heat td').length") == 6, "cells of the heat map")
    runner.check(browser.evaluate("document.querySelectorAll('.chart canvas').length") == 1, "the plot of the surfaces")
    opens(browser, folder / "identification" / "report.html", "identification, phone", width=390, height=844, phone=True, dark=True)
