"""What is wrong in a motion file is told with its line, whether the scene is checked or run, and nothing is written then."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

SMALL = runner.ROOT / "parameters" / "bar" / "small.prm"
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
motion = folder / "by_hand.motion"


def run(text, *words):
    motion.write_bytes(text.encode())
    return runner.run(*words, SMALL, "--quiet", "--output", folder / "results", "--set", f"Live/Motion={motion}", "--set", "Time/Step=0.01")


HOLD = "step 1 time 0.01 hold 28 2 0 2\n"
for text, line, words in [
        ("", None, ["nothing is done"]), ("# a comment\n\n", None, ["nothing is done"]),
        ("step 1 time 0.01 grap 28 2 0 2 by 28 1 0 0 0\n", 1, ["no deed 'grap'"]),
        ("step one time 0.01 wait\n", 1, ["step NUMBER time SECONDS DEED"]), ("step -1 time 0.01 wait\n", 1, ["step NUMBER"]),
        ("step 4294967297 time 0.01 wait\n", 1, ["step NUMBER"]), ("step 99999999999999999999 time 1 wait\n", 1, ["step NUMBER"]),
        ("step 1 time -1 wait\n", 1, ["step NUMBER"]), ("step 1 time nan wait\n", 1, ["step NUMBER"]), ("hold 28 2 0 2\n", 1, ["step NUMBER"]),
        ("step 1 time 0.01\n", 1, ["step NUMBER"]),
        ("step 5 time 0.05 wait\nstep 3 time 0.06 wait\n", 2, ["before the line above"]),
        ("step 5 time 0.05 wait\nstep 6 time 0.04 wait\n", 2, ["before the line above"]),
        ("step 1 time 0.01 end\nstep 2 time 0.02 wait\n", 2, ["has ended"]),
        ("step 1 time 0.01 end now\n", 1, ["no deed 'end'"]),
        ("step 1 time 0.01 hold 28 nan 0 2\n", 1, ["coordinate x", "finite"]), ("step 1 time 0.01 hold 28 1e400 0 2\n", 1, ["finite"]),
        ("step 1 time 0.01 hold 28 2 0\n", 1, ["coordinate z is missing"]), ("step 1 time 0.01 hold 28 2 0 2 3\n", 1, ["nothing more"]),
        ("step 1 time 0.01 hold 2.5 2 0 2\n", 1, ["whole number"]), ("step 1 time 0.01 hold 99999 2 0 2\n", 1, ["no cell with a vertex 99999"]),
        ("step 1 time 0.01 hold 80 4 12 4\n", 1, ["held or moved already"]), (HOLD + HOLD, 2, ["already"]),
        (HOLD + "step 2 time 0.02 move 28 2 0 2\n", 2, ["'over' is missing"]), (HOLD + "step 2 time 0.02 move 28 2 0 2 over 0\n", 2, ["greater than 0"]),
        (HOLD + "step 2 time 0.02 move 27 2 0 2 over 1\n", 2, ["no hand"]), (HOLD + "step 2 time 0.02 release 27\n", 2, ["no hand"]),
        ("step 1 time 0.01 grab 28 2 0 2\n", 1, ["'by' is missing"]), ("step 1 time 0.01 grab 28 2 0 2 by\n", 1, ["no vertex is pulled"]),
        ("step 1 time 0.01 grab 28 2 0 2 by 28 -1 0 0 0\n", 1, ["stiffness", "greater than 0"]),
        ("step 1 time 0.01 grab 28 2 0 2 by 28 1 0 0 0, 88888 1 0 0 0\n", 1, ["88888"]),
        ("step 1 time 0.01 take needle 0 0 0\n", 1, ["no tool needle"]), ("step 1 time 0.01 tool needle 0 0 0 over 1\n", 1, ["no hand has taken"]),
        ("step 1 time 0.01 set Mesh/Box cubes=1, 1, 1\n", 1, ["can't set Mesh/Box cubes"]),
        ("step 1 time 0.01 set Material/Young modulus\n", 1, ["Section/Entry=value"]),
        ("step 1 time 0.01 set Material/Young modulus=-1\n", 1, ["Young modulus", "greater than 0"]),
        ("step 1 time 0.01 set Loads/Gravity=1\n", 1, ["Gravity"])]:
    for words_before in (["--check"], []):
        error = runner.refused(run(text, *words_before), words, f"{words_before} {text!r}")
        runner.check(line is None or f"{motion}:{line}: " in error, f"{text!r}: no line {line} in {error}")
        runner.check(not (folder / "results").exists(), f"{text!r} leaves results")

# Blank lines, comments and carriage returns mean nothing.
status, _, error = run("# by hand\r\n\r\n" + HOLD.replace("\n", "\r\n") + "step 4 time 0.04 end\r\n")
runner.check(status == 0, f"{status}: {error}")
runner.check(len(runner.Results(folder / "results").history()) == 5, "the run ends elsewhere")

runner.refused(runner.run(SMALL, "--quiet", "--set", f"Live/Motion={folder}/none"), ["no such motion file"], "no file")
runner.refused(runner.run(SMALL, "--aim", "1 %", "--quiet", "--set", f"Live/Motion={motion}"), ["Live/Motion", "by hand"], "an aim")
runner.refused(runner.run(runner.ROOT / "parameters" / "studies" / "bar-small.prm", "--quiet", "--set", f"Live/Motion={motion}"), ["by hand"], "a study")
runner.refused(runner.run(SMALL, "--quiet", "--set", f"Live/Motion={motion}", "--set", "Time/Estimate error=true"), ["half the step"], "a second run")
