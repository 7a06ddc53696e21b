"""What a user can get wrong: exit status 1, one message with place and remedy, nothing written."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
scene = runner.BAR.read_text()


def refused(arguments, *words, ranks=1):
    """supple must refuse these arguments with a message that has these words."""
    status, output, error = runner.run(*arguments, "--output", folder / "results", ranks=ranks)
    where = f"{arguments[1:]}: exit status {status}\n{error}"
    runner.check(status == 1, where)
    for word in words:
        runner.check(word in error, f"'{word}' is missing in {where}")
    runner.check(error.startswith("supple: ") or ranks > 1, where)
    runner.check(len(error) < 1500 and "Stacktrace" not in error and "terminate" not in error, where)
    runner.check(output == "" and not (folder / "results").exists(), "something was written for " + where)


def with_setting(entry, value, *words):
    refused([runner.BAR, "--set", f"{entry}={value}"], "--set", *words)


def with_text(old, new, *words):
    runner.check(old in scene, f"'{old}' is not in the scene")
    path = folder / "scene.prm"
    path.write_text(scene.replace(old, new, 1))
    refused([path], *words)


refused(["no-such.prm"], "no-such.prm", "no such parameter file")
runner.check(not pathlib.Path("no-such.prm").exists(), "the missing file was created")
refused([folder], "no such parameter file")
refused([runner.BAR, "--frobnicate"], "--frobnicate", "no such option")
refused([runner.BAR, runner.BAR], "one scene at a time")
status, _, error = runner.run(runner.BAR, "--set")
runner.check(status == 1 and "must follow" in error, error)
status, _, error = runner.run(runner.BAR, "--output", "--quiet")
runner.check(status == 1 and "must follow" in error and not pathlib.Path("--quiet").exists(), error)
(folder / "empty.prm").write_text("\n")
refused([folder / "empty.prm"], "is empty")

line = next(i for i, text in enumerate(scene.splitlines(), 1) if "Young modulus" in text)
with_text("Young modulus", "Yung modulus", f"scene.prm:{line}:", "Yung modulus")
with_text("= 100e6", "= -100e6", f"scene.prm:{line}:", "-100e6", "Young modulus", "greater than 0")
with_text("subsection Material", "subsection Materials", "scene.prm:", "Materials")
with_text("set Poisson", "Poisson", "scene.prm:", "could not be parsed")
with_text("= polar\nend", "= polar", "scene.prm", "subsection")

with_setting("Material/Yung modulus", 3, "Yung modulus", "--print-parameters")

# The known name that is near, if one is nearer than all others.
with_text("Young modulus", "Yung modulus", "no entry Material/Yung modulus; did you mean 'Young modulus'?")
with_text("subsection Material", "subsection Materials", "no subsection Materials; did you mean 'Material'?")
with_text("= polar", "= polr", "none, gram-schmidt, polar; did you mean 'polar'?")
for entry, known in [("Material/young Modulus", "Young modulus"), ("Material/Young", "Young modulus"), ("Materal/Density", "Material"),
                     ("Motion 22/Of", "Motion 2"), ("Time/Stps", "Steps"), ("Mesh/Box", None), ("Time/Frobnicate", None), ("T/Step", None)]:
    status, _, error = runner.run(runner.BAR, "--set", f"{entry}=3")
    meant = error.split("did you mean ")[1].split("?")[0] if "did you mean" in error else "None"
    runner.check(status == 1 and meant == (repr(known) if known else "None"), f"{entry}: {error}")
for value, known in [("backwardeuler", "'backward euler'"), ("esdirk6", None), ("explicit", None), ("ID", "'ida'"), ("x", None)]:
    status, _, error = runner.run(runner.BAR, "--set", f"Time/Method={value}")
    runner.check(status == 1 and (f"did you mean {known}?" in error if known else "did you mean" not in error), error)
with_setting("Materials/Density", 3, "Materials")
refused([runner.BAR, "--set", "nonsense"], "Section/Entry=value")
for entry, values, words in [
        ("Material/Young modulus", [0, -1, "inf", "soft"], ["greater than 0"]),
        ("Material/Poisson ratio", [0.5, 0.7, -1, -2], ["greater than -1 and less than 0.5"]),
        ("Material/Density", [0, -1], ["greater than 0"]),
        ("Time/Step", [0, -0.1, "nan"], ["greater than 0"]),
        ("Time/Steps", [0, -3, 1.5, 4000000000], ["whole number, 1 or greater (at most 2147483647)"]),
        ("Mesh/Box size", ["4, 12, 0", "4, 12"], ["three values", "greater than 0"]),
        ("Mesh/Box cubes", ["2, 8, 0", "2, 8, 2, 2"], ["three values", "1 or greater"]),
        ("Corotation/Rotation", ["quaternion"], ["none, gram-schmidt, polar"]),
        ("Loads/Gravity", ["0, 0, nan"], ["three values"]),
        ("Loads/Body force", ["x +; 0; 0"], ["Unexpected end"]),
        ("Loads/Body force", ["x; 0"], ["found 2", "3"]),
        ("Loads/Body force", ["w; 0; 0"], ["w", "x, y, z, t"]),
        ("Start/Velocity", ["1/0; 0; 0", "sqrt(-1); 0; 0"], ["finite"]),
        ("Constraints/Clamped boundaries", ["7"], ["no boundary 7", "3 (8 faces)"]),
        ("Constraints/Clamped boundaries", ["top"], ["no boundary id", "no single group"]),
        ("Constraints/Clamped region", ["x > 100"], ["no vertex", "[0, 4] x [0, 12] x [0, 4]", "0, 1, 2, 3, 4, 5"]),
        ("Constraints/Clamped region", ["x >"], ["Unexpected end"]),
        ("Constraints/Clamped region", ["sqrt(x - 50)"], ["finite"]),
        ("Constraints/Clamped region", ["t > 1"], ["can't depend on the time"]),
        ("Loads/Body force", ["1/x; 0; 0"], ["finite", "at time 0"]),
        ("Constraints/Boundaries held along y", ["9"], ["no boundary 9"]),
        ("Probes/Points", ["tip 0, 0, 0"], ["name: value"]),
        ("Probes/Points", ["tip: 0, 0", "tip: nan, 0, 0", "tip: x, y, z"], ["is no point"]),
        ("Probes/Points", ["a: 0, 0, 0; a: 1, 1, 1"], ["'a' is given twice"]),
        ("Probes/Boundaries", ["wall: x", "wall: 99999999999999999999", "wall: 4294967299"], ["no boundary id"]),
        ("Probes/Boundaries", ["wall: 8"], ["no boundary 8"]),
        ("Probes/Regions", ["end: y > 13"], ["no vertex"])]:
    for value in values:
        with_setting(entry, value, *words)

refused([runner.BAR, "--set", "Material/Elastic constants=Lame", "--set", "Material/Lame lambda=-7e5", "--set",
         "Material/Lame mu=1e6"], "3 lambda + 2 mu")
refused([runner.BAR, "--set", "Time/Problem=static", "--set", "Damping/Viscous=1"], "static", "damping")

refused([runner.BAR, "--set", "Time/Problem=static"], "Start/Velocity", "static")

static = [runner.BAR, "--set", "Time/Problem=static", "--set", "Start/Velocity=0; 0; 0", "--set", "Constraints/Clamped boundaries="]
refused(static, "6 of its 6 rigid motions are free", "Hold a boundary")
refused([*static, "--set", "Constraints/Boundaries held along y=3"], "3 of its 6 rigid motions are free")
refused([*static, "--set", "Constraints/Clamped region=x == 0 && y == 0 && z == 0"], "3 of its 6 rigid")

# Starts whose energies are beyond the largest number.
for entry, values in [("Start/Velocity", ["0; 0; -1e155", "-1e160; 0; 0"]), ("Start/Displacement", ["1e200*x; 0; 0"])]:
    for value in values:
        with_setting(entry, value, entry, "too large", "no finite numbers", "[0, 4] x [0, 12] x [0, 4]")
        refused(["--check", runner.BAR, "--set", f"{entry}={value}"], "too large")

# An output folder that can't be: beneath a regular file, so that it holds for root too.
(folder / "file").write_text("")
status, output, error = runner.run(runner.BAR, "--output", folder / "file" / "results")
runner.check(status == 1 and "can't be written" in error and "--output" in error and output == "", error)

# A process without any cell.
status, _, error = runner.run(runner.BAR, "--set", "Mesh/Box cubes=1, 1, 1", "--set", "Probes/Points=", ranks=7)
runner.check(status == 1 and error.count("7 processes are too many for 6 cells") == 1, error)

# On two processes the message comes once.
status, _, error = runner.run(runner.BAR, "--set", "Constraints/Clamped region=x > 100", ranks=2)
runner.check(status == 1 and error.count("this region has no vertex") == 1, error)

# A map of the mesh.
with_setting("Mesh/Map", "x; y", "found 2 expression(s)", "must be 3")
with_setting("Mesh/Map", "x; y; z/x", "Mesh/Map", "is put at", "a place for each vertex")
with_setting("Mesh/Map", "x; y + t; z", "does not depend on t")
with_setting("Mesh/Map", "abs(x - 1); y; z", "turns 96 of 192 cells inside out", "must not fold")
refused([runner.BAR, "--set", "Mesh/Shape=rectangle", "--set", "Mesh/Map=x; y; 1", "--set", "Constraints/Boundaries held along z="],
        "plane z = 0")

# Lines longer than any regular expression bears, in one piece or several; messages stay short and leave the terminal alone.
for name, text, most in [("long", "set Map = " + "x" * 300000, 4000),
                         ("continued", "set Map = " + ("x" * 99 + "\\\n") * 3000, 12000)]:
    scene = folder / f"{name}.prm"
    scene.write_text(f"subsection Mesh\n{text}\nend\n")
    status, _, error = runner.run("--check", scene)
    runner.check(status == 1 and f"characters; at most {most} are read" in error and f"{name}.prm:" in error, error[:1000])
scene = folder / "almost.prm"
scene.write_text("subsection Mesh\nset Map = " + ("x" * 99 + "\\\n") * 120 + "\nend\n")
status, _, error = runner.run("--check", scene)
runner.check(status == 1 and "Mesh/Map" in error, error[:1000])
refused([runner.BAR, "--set", "Mesh/Shape=file", "--set", "Mesh/File=" + 400 * "x" + ".msh"], "there is no such file")
circle, other = folder / "circle.prm", folder / "other.prm"
for first, second, words in [(circle, circle, "circle.prm includes itself"), (other, circle, "circle.prm includes itself"),
                             (folder / "no-such", circle, "there is no file")]:
    circle.write_text(f"subsection Time\nend\ninclude {first}\n")
    other.write_text(f"include {second}\n")
    status, _, error = runner.run("--check", circle)
    runner.check(status == 1 and words in error, f"exit status {status}: {error}")
with_setting("Mesh/Map", "x" * 100000, "characters; at most 4000 are read")
status, _, error = runner.run("--check", runner.BAR, "--set", "Mesh/Map=\x1b[2J" + "x" * 3000)
runner.check(status == 1 and "\x1b" not in error and "Mesh/Map = ?[2Jxxx" in error and " ... " in error and len(error) < 1500, error)

# Of two lines that set one entry one would count for nothing.
twice = folder / "twice.prm"
for text, words in [("subsection Motion\n set Of = boundary 0\nend\nsubsection Motion\n set  Of = all\nend\n",
                     ["twice.prm:5: Motion/Of is set already", "twice.prm:2", "subsection Motion 2"]),
                    ("subsection Time\n set Steps = 2\n set Steps=3\nend\n", ["twice.prm:3: Time/Steps", "twice.prm:2"])]:
    twice.write_text(text)
    refused([twice], *words)
base = folder / "base.prm"
base.write_text("subsection Time\n set Steps = 2\nend\n")
twice.write_text(f"include {base}\nsubsection Time\n set Steps = 3\nend\n")
status, output, error = runner.run("--check", twice)
runner.check(status == 0 and "3 steps" in output, f"an entry of an included file can't be changed: {output} {error}")
twice.write_text(f"subsection Time\n set Steps = 3\nend\ninclude {base}\n")
refused([twice], "base.prm:2: Time/Steps is set already", "twice.prm:2")
other.write_text("subsection Time\n set Steps = 4\nend\n")
twice.write_text(f"include {base}\ninclude {other}\n")
refused([twice], "Time/Steps is set already", "base.prm:2")
twice.write_text("subsection Time\n set Steps = -3\nend\n")
other.write_text(f"include {twice}\n")
refused([other], "twice.prm:2: ", "whole number")

# What can't be seen, and what would be cut off.
twice.write_bytes(b"\xef\xbb\xbf" + base.read_bytes())
refused([twice], "twice.prm:1", "byte order mark")
twice.write_text("subsection Mesh\n set Shape = file\n set File = a#b.msh\nend\n")
refused([twice], "twice.prm:3", "only 'a' is left")
with_setting("Mesh/File", "two#x.msh", "only 'two' is left")
twice.write_text("subsection Time\n set Steps = 2 # as many as it takes\nend # of it\n")
runner.check(runner.run("--check", twice)[0] == 0, "a comment")
refused([runner.BAR, "--set", "Time/Steps=2", "--set", " Time / Steps =3"], "Time/Steps is set already", "Time/Steps=2")
with_setting("Material/By id", "1: 1e6, 0.3, 1000; 2: 1e6, 0.3, 1000; 1: 2e6, 0.3, 1000", "material id 1 is given twice")

# What an expression would be read as, though it is not meant.
for entry, value, words in [
        ("Loads/Traction", "0; 0; 1,5", "The decimal sign is a point"),
        ("Loads/Body force", "0; 0; (1,5)*t", "The decimal sign is a point"),
        ("Loads/Pressure", "2*min(t, 1),5", "The decimal sign is a point"),
        ("Constraints/Clamped region", "x < 0,15", "The decimal sign is a point"),
        ("Constraints/Clamped region", "x = 0.1", "Equal is =="),
        ("Loads/Gravity", "0; 0; if(t = 1, 1, 0)", "Equal is =="),
        ("Constraints/Clamped region", "x => 0.1", "at least is >="),
        ("Constraints/Clamped region", "0.05 < x < 0.15", "a < x && x < b"),
        ("Constraints/Clamped region", "x > 1 && 2 >= y >= 1", "a < x && x < b"),
        ("Start/Velocity", "0; 0; if(0 < x <= 1, 1, 0)", "a < x && x < b"),
        ("Mesh/Map", "x; y; z + (0 < x < 1)", "a < x && x < b"),
        ("Mesh/Boundary regions", "7: 0 <= y <= 1", "a < x && x < b"),
        ("Probes/Regions", "end: y = 1", "Equal is =="),
        ("Loads/Body force", ";0;0", "is empty"),
        ("Loads/Body force", "sin    (x) + q; 0; 0", "at character 14: Unexpected token"),
        ("Loads/Body force", "-;0;0", "at character 2: something is missing"),
        ("Loads/Body force", "x y;0;0", 'at character 3: Unexpected variable "y".'),
        ("Loads/Gravity", "0; 0; 2*(x + 3", "at character 9: Missing parenthesis"),
        ("Mesh/Map", "x; y; wide*z", "at character 1: Unexpected token"),
        ("Constraints/Clamped region", "sin(x, 1) > 0", "Too many parameters"),
        ("Constraints/Clamped region", "x < 1 and y > 0", "at character 7: and is &&"),
        ("Constraints/Clamped region", "not (x < 1)", "not is !")]:
    with_setting(entry, value, words)
refused([runner.BAR, "--set", "Constraints/Clamped boundaries=", "--set", "Motion/Of=all", "--set", "Motion/Displacement=0; 0,01*t; 0"],
        "The decimal sign is a point")
for entry, value in [("Constraints/Clamped region", "(0.05 < x) && x <= 0.15 || !(y >= 1) == 1"),
                     ("Loads/Body force", "if(t >= 1, max(1, 2, x), 0); atan2 (x, y); t != 1 ? 1 : 2 < 3"),
                     ("Constraints/Clamped region", "if(x < 1, y < 1, z > 1 && x <= 2)"),
                     ("Loads/Body force", "log(exp(1)) + int(2.6) - 3*if(1 & 0 | 1, 1, 2); 0; 0"), ("Mesh/Map", "x*sqrt (1); y; z + sec(0) - 1")]:
    status, _, error = runner.run("--check", runner.BAR, "--set", f"{entry}={value}")
    runner.check(status == 0, f"{value}: {error}")
