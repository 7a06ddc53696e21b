"""scripts/convert-mesh.py: sets of Abaqus become groups with names; without meshio the packages to install are named."""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
body = folder / "body.inp"
body.write_text("*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n"
                "*ELSET, ELSET=soft\n1\n*ELSET, ELSET=hard\n2\n")
scene = folder / "scene.prm"
scene.write_text("# a mesh file\nsubsection Mesh\n  set Shape = file\nend\n")


def convert(python, *options):
    command = [python, *options, runner.ROOT / "scripts" / "convert-mesh.py", body]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


# Without the packages of the system (-S) there is no meshio.
status, text = convert(sys.executable, "-S", "-E")
runner.check(status == 1 and "python3-meshio" in text and "Traceback" not in text, f"exit status {status}, {text}")

pythons = [python for python in (sys.executable, "/usr/bin/python3")
           if subprocess.run([python, "-c", "import meshio"], capture_output=True).returncode == 0]
if not pythons:
    print("meshio is not installed: no file is converted")
    sys.exit()
status, text = convert(pythons[0])
runner.check(status == 0, text)
status, output, error = runner.run("--check", scene, "--set", "Mesh/File=body.msh", "--set", "Material/By id=hard: 1e7, 0.3, 1000")
runner.check(status == 0, error)
for words in ("2 tetrahedra, 5 vertices", "0.5 m^3", "hard (material 1), soft (material 2)", "materials   1 (1), 2 (1)"):
    runner.check(words in output, f"'{words}' is missing in\n{output}")
