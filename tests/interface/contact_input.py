"""What a user can get wrong with tools: exit status 1 and one message with place and remedy; what is worth a warning."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
SCENE = folder / "scene.prm"
SOLID = """# a cube above a floor
subsection Mesh
  set Box origin = 0, 0, 0.01
  set Box size   = 0.1, 0.1, 0.1
  set Box cubes  = 2, 2, 2
end
subsection Material
  set Young modulus = 1e5
end
subsection Tool floor
  set Shape = plane
end
subsection Time
  set Step  = 0.01
  set Steps = 2
end
subsection Output
  set Frames = none
  set Report = false
end
"""
PLANE = SOLID.replace("set Box origin = 0, 0, 0.01", "set Shape = rectangle\n  set Rectangle origin = 0, 0.01") \
    .replace("set Box size   = 0.1, 0.1, 0.1", "set Rectangle size = 0.1, 0.1") \
    .replace("set Box cubes  = 2, 2, 2", "set Rectangle squares = 2, 2") \
    .replace("set Shape = plane", "set Shape = plane\n  set Normal = 0, 1, 0")


def refused(settings, *words, scene=SOLID, more=""):
    SCENE.write_text(scene + more)
    status, output, error = runner.run(SCENE, "--output", folder / "results", *runner.overrides(settings))
    where = f"{settings} {more}: exit status {status}\n{error}"
    runner.check(status == 1 and error.startswith("supple: ") and "Stacktrace" not in error, where)
    for word in words:
        runner.check(word in error, f"'{word}' is missing in {where}")
    runner.check(output == "" and not (folder / "results").exists(), "something was written for " + where)


def warned(settings, *words, scene=SOLID, more=""):
    """The warnings of a run that succeeds have these words; without words there is none of tools."""
    SCENE.write_text(scene + more)
    warnings = " ".join(runner.simulate(SCENE, settings).summary()["warnings"])
    for word in words:
        runner.check(word in warnings, f"'{word}' is missing in the warnings of {settings} {more}: {warnings}")
    return warnings


# Entries of tools, which are declared for each name that the file has.
refused({}, "no entry Tool ball/Radios", "did you mean 'Radius'?", more="subsection Tool ball\n set Radios = 1\nend\n")
refused({"Tool table/Radius": 1}, "no subsection Tool table")
refused({}, "scene.prm:21:", "the name of a tool has letters", more="subsection Tool a.b\nend\n")
refused({"Tool floor/Shape": "wall"}, "--set", "one of plane, sphere, capsule")
refused({"Tool floor/Friction": -0.1}, "0 or greater")
refused({"Tool floor/Radius": 0}, "greater than 0")
refused({"Tool floor/Normal": "0, 0, 0"}, "Tool floor/Normal", "a direction toward the body")
refused({"Tool floor/Normal": "1, 0"}, "three values")
refused({"Tool floor/Position": "0; 0; zz"}, "Tool floor/Position", "zz")
refused({"Tool floor/Position": "0; 0"}, "Tool floor/Position")
refused({"Contact/Stiffness": -1}, "0 or greater")
refused({"Contact/Guard": 0}, "greater than 0")
refused({}, "a capsule of no length is a sphere", more="subsection Tool pin\n set Shape = capsule\n set Axis = 0, 0, 0\nend\n")

# A start within a tool: which vertex, which tool, how deep; a needle may be thinner than a cell, or go right through.
refused({"Tool floor/Position": "0; 0; 0.03"}, "at the start the tool floor is 0.02 m deep in the body", "vertex 0 at (0, 0, 0.01)")
pin = "subsection Tool pin\n set Shape = capsule\n set Radius = 0.001\n set Position = {}\n set Axis = 0.01, 0.013, -0.2\nend\n"
refused({}, "at the start the tool pin is", "deep in the body", more=pin.format("0.033; 0.021; 0.15"))
refused({}, "at the start the tool ball is", more="subsection Tool ball\n set Radius = 0.05\n set Position = 0.05; 0.05; 0.15\nend\n")

# Methods that do not end with a stage, friction with methods that would gain nothing, bodies that tools can't touch.
for method in ("implicit midpoint", "sdirk2", "imex3", "explicit2", "ida"):
    refused({"Time/Method": method, "Material/Mass": "lumped"}, "--set: Time/Method", "must end with an implicit stage", "trbdf2")
refused({"Time/Method": "esdirk5"}, "Time/Method", "energy grows")
refused({"Time/Method": "trbdf2", "Tool floor/Friction": 0.1}, "Tool floor/Friction", "of first order")
refused({"Plane/Model": "axisymmetric"}, "axisymmetric bodies do not touch anything", scene=PLANE)
refused({"Tool floor/Position": "0; 0; t"}, "the tool must stay in it", scene=PLANE)
refused({"Tool floor/Rotation": "0; 10; 0"}, "it can turn about z alone", scene=PLANE)
refused({"Tool floor/Normal": "0, 1, 1"}, "third component must be 0", scene=PLANE)

# Tools of files, and boxes.
pin = "subsection Tool pin\n set Shape = file\n set File = {}\n set Position = 0.05; 0.05; 0.3\nend\n"
(folder / "broken.stl").write_bytes(b"\x00\xff" * 60)
(folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
(folder / "open.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
refused({}, "Tool pin/File", "no file", more=pin.format("nowhere.stl"))
refused({}, "Tool pin/File", ".stl, .obj or .ply", more=pin.format("mesh.msh"))
refused({}, "Tool pin/File", "broken.stl", more=pin.format("broken.stl"))
refused({}, "no triangles with an area", more=pin.format("flat.obj"))
refused({}, "needs a surface of triangles", more="subsection Tool pin\n set Shape = file\nend\n")
warned({}, "The surface of the tool pin is not closed", more=pin.format("open.obj"))
refused({"Tool floor/Shape": "box", "Tool floor/Size": "0, 1, 1"}, "Tool floor/Size")
refused({"Tool floor/Position": "x; 0; 0"}, "x, y and z mean nothing in them")
refused({"Tool floor/Position": "1/t; 0; 0"}, "not a finite number")
refused({"Contact/Reach": 1}, "more than a tenth of the body's diameter")
inside = "subsection Tool ball\n set Shape = sphere\n set Radius = 0.001\n set Position = 0.043; 0.051; 0.062\nend\n"
refused({}, "the tool ball is wholly within the body", more=inside)
warned({"Tool floor/Position": "0; 0; 0.011", "Tool floor/Friction": 0.1, "Tool floor/Rotation": "0; 0; 1000*t", "Contact/Reach": 0.005},
       "The tool floor turned by 10 degrees within a step")

# Bodies that touch each other.
refused({"Mesh/Piece maps": "x; y; z | x + 0.05; y; z", "Contact/Bodies": "pieces"}, "Contact/Bodies", "the surface meets itself")
refused({"Mesh/Piece maps": "x; y; z | 0.05 + 0.1*x; 0.05 + 0.1*y; 0.05 + 0.1*z", "Contact/Bodies": "pieces"}, "a piece of the body is within another")
refused({"Mesh/Piece maps": "x; y"}, "Mesh/Piece maps")
refused({"Contact/Bodies": "all", "Time/Method": "ida"}, "bodies that meet each other", "must end with an implicit stage",
        scene=SOLID.replace("subsection Tool floor\n  set Shape = plane\nend\n", ""))
refused({"Contact/Bodies": "all", "Contact/Friction": 0.1, "Time/Method": "trbdf2"}, "Contact/Friction", "of first order")
warned({"Mesh/Piece maps": "x; y; z | x; y; z + 0.10001", "Contact/Bodies": "pieces"}, "At the start bodies are 1e-05 m apart")
SCENE.write_text(SOLID)
refused({"Mesh/Piece maps": "x; y; z |"}, "no map after the last")
status, _, error = runner.run(SCENE, "--output", folder / "results", *runner.overrides({"Contact/Bodies": "all"}), ranks=2)
runner.check(status == 1 and "on one process alone" in error, f"{status}: {error}")

# The tools are drawn beside each frame.
drawn = runner.simulate(SCENE, {"Output/Frames": "every", "Output/Report": "true"})
shapes = sorted((drawn.folder / "solution").glob("tools_*.vtp"))
runner.check(len(shapes) == 3 and all(file.name in (drawn.folder / "tools.pvd").read_text() for file in shapes), f"{shapes}")
runner.check('NumberOfPolys="2"' in shapes[0].read_text() and '"name":"floor"' in (drawn.folder / "report.html").read_text(), "no tools in picture and page")

# Warnings: thin tools and the cells that would do, a start in contact, a tool that touches nothing, entries without effect.
thin = "subsection Tool pin\n set Shape = capsule\n set Radius = 0.001\n set Position = 0.03; 0.02; 0.115\n set Axis = 0, 0, 0.1\nend\n"
warned({}, "The tool pin, with a radius of 0.001 m, is thinner than the cells", "Edges of less than 0.001 m would do", more=thin)
warned({"Tool floor/Position": "0; 0; 0.01004"}, "At the start the tool floor is 4e-05 m deep in the body")
warned({}, "The tool floor never touched the body: it came no nearer than 0.01 m")
warned({"Tool floor/Axis": "0, 0, 1"}, "Tool floor/Axis", "it has no effect", "Shape is not capsule")
warned({"Contact/Slip resolution": 0.1}, "Contact/Slip resolution", "nothing has friction")
runner.check("never touched" not in warned({"Tool floor/Position": "0; 0; 0.01", "Start/Velocity": "0; 0; -0.1"}), "it touches")
SCENE.write_text(SOLID.replace("subsection Tool floor\n  set Shape = plane\nend\n", "subsection Contact\n set Guard = 0.2\nend\n"))
results = runner.simulate(SCENE, {})
runner.check("there is no subsection Tool" in " ".join(results.summary()["warnings"]), "Contact without tools")

# Without tools nothing is there of them.
runner.check("contact" not in results.summary() and "tools" not in results.summary()["built"], "contact in summary.json")
runner.check((results.folder / "history.csv").read_text().splitlines()[0].endswith(",seconds"), "columns of contact")

# A held part that a tool is driven into: exit status 2, with the names.
SCENE.write_text(SOLID)
for more in ({}, {"Time/Problem": "static", "Time/Steps": 4}):
    end = 1 if more else 0.02
    held = {"Constraints/Clamped boundaries": 5, "Tool floor/Position": f"0; 0; 0.2*t/{end}", **more}
    status, _, error = runner.run(SCENE, "--quiet", "--output", folder / "driven", *runner.overrides(held))
    runner.check(status == 2 and "the tool floor would reach vertex" in error and "held" in error, f"{status}: {error}")
