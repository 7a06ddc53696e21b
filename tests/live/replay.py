"""What was done by hand is a scene: it gives the same digits in batch, the same numbers on two processes, goes on from a
checkpoint, and with half the step it tells the error."""

import pathlib
import shutil
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import live_client
import runner

SMALL = runner.ROOT / "parameters" / "bar" / "small.prm"
NEEDLE = runner.ROOT / "parameters" / "contact" / "needle-skin.prm"
SETTINGS = {"Time/Step": 0.01, "Start/Velocity": "0; 0; -2", "Output/Frames": "every", "Output/Every": 25, "Checkpoint/Every": 30, "Solver/Tolerance": 1e-12}


def bar_session(ranks, settings, more=()):
    """A bar that is pulled, held, softened, weighed and computed otherwise."""
    with live_client.Session(SMALL, settings, ranks) as session:
        page = live_client.Page(session)
        page.do("run")
        page.steps(10)
        page.go_by("grab", 28, (0, 0, 0.1), " 0 0")
        for k in range(5):
            page.steps(3)
            page.do("set Material/Young modulus=-1")  # refused: the hand must stay what it was
            page.answer("refused")
            page.go_by("move", 28, (0, 0, 0.1))
        page.do("set Loads/Gravity=0, 0, 4")
        page.steps(10)
        page.do("set Material/Young modulus=2e8")
        page.steps(5)
        page.do("release 28")
        page.do("set Time/Method=trbdf2")
        page.steps(8)
        page.go_by("hold", 56, (0, 0, 0))
        page.steps(5)
        page.go_by("grab", 0, (-0.1, 0, 0.1), " 2.1 0")
        page.steps(6)
        for command in more:
            page.do(command)
            page.steps(5)
        page.until(lambda: len(page.rows[-1]["pulls"]) == 2, "the forces of two hands")
        page.do("pause")
        page.until(lambda: not page.state()["running"], "the pause")
        page.quit()
        runner.check(session.end() == 0, f"the session ends with {session.end()}")
        return runner.Results(session.folder)


def without_seconds(results, table):
    return [{name: text for name, text in row.items() if name != "seconds"} for row in results.table(table)]


def same_digits(session, repeated, what):
    for table in ("history.csv", "probes.csv", "hands.csv"):
        first, second = without_seconds(session, table), without_seconds(repeated, table)
        runner.check(first == second, f"{what}: {table} differs")
    runner.check(len(session.history()) > 10, f"{what}: the session has {len(session.history())} rows")
    runner.check(session.frame_times() == repeated.frame_times(), f"{what}: frames")
    runner.check((session.folder / "session.motion").read_text() == (repeated.folder / "session.motion").read_text(), f"{what}: motion")


def repeat(session, settings=None, ranks=1, folder=None):
    folder = folder or tempfile.mkdtemp(prefix="supple-")
    status, _, error = runner.run(session.folder / "live.prm", "--quiet", "--output", folder, *runner.overrides(settings or {}), ranks=ranks)
    runner.check(status == 0, f"live.prm ends with {status}: {error}")
    return runner.Results(folder)


session = bar_session(1, SETTINGS)
same_digits(session, repeat(session), "once more")
runner.check(len(session.table("hands.csv")) > 20, "the forces of the hands are not in hands.csv")
COLUMNS = [name for name in session.probes()[0] if ".u" in name]
difference = runner.largest_difference(session.probes(), repeat(session, ranks=2).probes(), COLUMNS)
runner.check(difference < 1e-8, f"on two processes the displacements differ by {difference}")
first, last = session.history()[0], session.history()[-1]
balance = [row["total"] + row["dissipated"] - row["work"] for row in session.history()]
runner.check(max(balance) - min(balance) < 1e-9 * max(abs(row["work"]) + row["total"] for row in session.history()),
             f"the balance of energies moves from {min(balance)} to {max(balance)}")

# From a checkpoint in the middle: the rest of the deeds is done after it.
part = tempfile.mkdtemp(prefix="supple-")
lines = (session.folder / "session.motion").read_text().splitlines(keepends=True)
middle = int(lines[-1].split()[1]) // 2
shutil.copytree(session.folder, part, dirs_exist_ok=True, ignore=shutil.ignore_patterns("checkpoint*", "*.csv", "solution*"))
short = pathlib.Path(part) / "session.motion"
short.write_text("".join(line for line in lines if int(line.split()[1]) < middle) + f"step {middle} time {middle * 0.01} end\n")
begun = repeat(runner.Results(part), folder=part + "/run")
short.write_text("".join(lines))
gone_on = repeat(runner.Results(part), {"Checkpoint/Resume": "auto"}, folder=part + "/run")
whole = repeat(session)
difference = runner.largest_difference(whole.probes(), gone_on.probes(), COLUMNS)
runner.check(difference < 1e-12, f"from a checkpoint at about step {middle} the displacements differ by {difference}")
runner.check(len(gone_on.table("hands.csv")) == len(whole.table("hands.csv")), "rows of hands.csv are lost or doubled")

# On two processes a session tells the same numbers as its repetition on one.
spread = bar_session(2, SETTINGS)
difference = runner.largest_difference(spread.probes(), repeat(spread).probes(), COLUMNS)
runner.check(difference < 1e-8, f"a session on two processes differs by {difference} from its repetition on one")

# With half the step, at the same times: another number of steps, and an error that is told.
finer = repeat(session, {"Live/By": "time", "Time/Step": 0.005, "Time/Steps": 200})
end = session.probes()[-1]
runner.check(abs(finer.probes()[-1]["time"] - end["time"]) < 1e-9, "half the step ends at another time")
runner.check(len(finer.probes()) == 2 * len(session.probes()) - 1, f"half the step has {len(finer.probes())} rows")
off = max(abs(finer.probes()[-1][name] - end[name]) for name in COLUMNS)
runner.check(1e-6 < off < 0.5, f"with half the step the displacements differ by {off} m")

# A tool: the needle goes in and out.
with live_client.Session(NEEDLE, {}) as touching:
    page = live_client.Page(touching)
    page.do("speed 0")
    page.do("run")
    page.steps(2)
    for depth in (0.0, -0.0004, -0.0008, 0.0004):
        page.do(f"tool needle 0 {0.0005 + depth} 0")
        page.steps(3)
    page.do("pause")
    page.until(lambda: not page.state()["running"], "the pause")
    told = page.rows[-1]["tools"]["needle"] or page.rows[-2]["tools"]["needle"]
    page.quit()
    touching.end()
needle = runner.Results(touching.folder)
again = repeat(needle)
same_digits(needle, again, "the needle")
runner.check(needle.table("tool_needle.csv") == again.table("tool_needle.csv"), "the needle's table differs")
deepest = max(abs(row["fy"]) for row in needle.table("tool_needle.csv"))
runner.check(deepest > 1e-4, f"the needle's largest force is {deepest} N")

# A step that fails is undone with what was done for it, and leaves no trace in the energies.
with live_client.Session(SMALL, SETTINGS) as troubled:
    page = live_client.Page(troubled)
    page.do("run")
    page.steps(6)
    page.do("pause")
    page.until(lambda: not page.state()["running"], "the pause")
    page.do("set Loads/Body force=0; 0; 1e3*sin(t)")
    page.do("step")
    page.steps(1)
    page.do("hold 56 1e200 0 0")
    page.do("step")
    failure = page.answer("failed")
    runner.check("failed" in failure["message"] and "undone" in failure["message"], f"{failure}")
    page.do("set Loads/Gravity=0; 0; -9*t")
    page.do("run")
    page.steps(6)
    page.quit()
    runner.check(troubled.end() == 0, f"the session ends with {troubled.end()}")
troubled = runner.Results(troubled.folder)
rows = troubled.history()
balance = [row["total"] + row["dissipated"] - row["work"] for row in rows]
runner.check(max(balance) - min(balance) < 1e-9 * max(abs(row["total"]) for row in rows), f"after a step that failed the balance is {balance}")
runner.check("hold" not in (troubled.folder / "session.motion").read_text(), "the deed that made a step fail is kept")
same_digits(troubled, repeat(troubled), "after a step that failed")

# A motion that was cut off is repeated up to its last line, with a word; a repetition in its own folder keeps the motion.
cut = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
shutil.copy(session.folder / "live.prm", cut)
(cut / "session.motion").write_text("".join(lines[:-3]))
status, output, error = runner.run(cut / "live.prm", "--output", cut)
runner.check(status == 0 and "cut off" in output, f"{status}: {output}{error}")
runner.check((cut / "session.motion").read_text() == "".join(lines[:-3]), "the motion is another one after its repetition in its folder")
