"""What a run must have left in its folder, whatever its scene: whole files of finite numbers that agree with one another, and a
word where the time stepping adds energy."""

import csv
import json
import math
import re
import xml.etree.ElementTree

import vtu

# Of the largest sum of kinetic and elastic energy, as the program has it (doc/guide.md), and of what is summed up.
GAIN_WITH_WARNING = 0.01
ROUND_OFF = 1e-9
GAIN_IN_WORDS = "The time stepping added"
# Of a run of thousands of frames so many are read, at most.
MOST_FRAMES = 100
ALWAYS = {"parameters.prm", "summary.json"}


class Wrong(Exception):
    """Something is wrong with the folder."""


def require(condition, message):
    if not condition:
        raise Wrong(message)


def not_finite(word):
    raise Wrong(f"summary.json has {word}")


def parameters(folder):
    """{"Section/Entry": value} of parameters.prm."""
    found, section = {}, ""
    for line in (folder / "parameters.prm").read_text().splitlines():
        if match := re.match(r"subsection (.*)", line):
            section = match[1]
        elif match := re.match(r"  set (.*?)\s*= ?(.*)", line):
            found[f"{section}/{match[1]}"] = match[2].split("#")[0].strip()
    return found


def numbers(values, where):
    require(all(math.isfinite(value) for value in values), f"{where} has a number that is not finite")


class RunFolder:
    """The folder of a run that has ended with exit status 0 or 2."""

    def __init__(self, folder, status):
        self.folder = folder
        self.status = status
        self.parameters = parameters(folder)
        self.summary = json.loads((folder / "summary.json").read_text(), parse_constant=not_finite)
        self.history = []

    def on(self, entry):
        return self.parameters[entry] == "true"

    def check(self):
        """Throws Wrong, or what the libraries throw that can't read a file."""
        self.check_status()
        self.check_names()
        self.check_tables()
        self.check_frames()
        if self.history:
            self.check_energy()
        if self.status == 0 and self.parameters["Time/Problem"] == "static":
            self.check_balance()

    def check_status(self):
        said = self.summary["status"]
        expected = ("done",) if self.status == 0 else ("interrupted", "failed: ")
        require(said.startswith(expected), f"exit status {self.status}, but summary.json says {said}")

    def check_names(self):
        history, frames = self.on("Output/History"), self.parameters["Output/Frames"] != "none"
        names = {path.name for path in self.folder.iterdir() if path.is_file()}
        needed = ALWAYS | ({"history.csv"} if history else set()) | ({"solution.pvd"} if frames else set())
        if self.on("Output/Report") and (history or frames):
            needed.add("report.html")
        if history and any(self.parameters[f"Probes/{kind}"] for kind in ("Boundaries", "Points", "Regions")):
            needed.add("probes.csv")
        if self.on("Output/Mesh"):
            needed.add("mesh.msh")
        allowed = needed | {"probes.csv", "error.csv"}
        if any(self.parameters[f"Checkpoint/{entry}"] not in ("0", "never") for entry in ("Every", "Minutes", "Resume")):
            allowed |= {"checkpoint.cbor", "checkpoint.previous.cbor", "report.frames"}
        profiles = {name for name in names if name.startswith("profile_")}
        require(needed <= names, f"{needed - names} is missing")
        require(names <= allowed | profiles, f"{names - allowed - profiles} is left over")
        require(len(profiles) == (history and self.parameters["Probes/Profiles"].count(":")), f"{len(profiles)} profiles")
        if "report.html" in names:
            require((self.folder / "report.html").read_text().rstrip().endswith("</html>"), "report.html is half written")

    def table(self, name):
        text = (self.folder / name).read_text()
        require(text.endswith("\n"), f"{name} ends within a line")
        rows = [{column: float(value) for column, value in row.items()} for row in csv.DictReader(text.splitlines())]
        require(rows or name == "error.csv", f"{name} has no row")    # an error is known from the first step on
        for row in rows:
            numbers(row.values(), name)
        return rows

    def check_tables(self):
        tables = {path.name: self.table(path.name) for path in self.folder.glob("*.csv")}
        self.history = tables.get("history.csv", [])
        for name in {"history.csv", "probes.csv"} & set(tables):
            steps = [row["step"] for row in tables[name]]
            require(steps == list(range(self.summary["steps"] + 1)), f"{name} has other rows than the {self.summary['steps']} steps")
        for name, rows in tables.items():
            times = [row["time"] for row in rows]
            require(times == sorted(times), f"the time of {name} goes back")
        if self.history and self.status == 0:
            static = self.parameters["Time/Problem"] == "static"
            end = 1 if static else float(self.parameters["Time/Step"]) * int(self.parameters["Time/Steps"])
            require(abs(self.history[-1]["time"] - end) <= 1e-9 * end, f"it is done at {self.history[-1]['time']} and not at {end}")

    def check_frames(self):
        if self.parameters["Output/Frames"] == "none":
            return
        entries = xml.etree.ElementTree.parse(self.folder / "solution.pvd").getroot().findall("Collection/DataSet")
        require(len(entries) == self.summary["built"]["frames"], f"{len(entries)} frames in solution.pvd, others in summary.json")
        pieces = set()
        for entry in entries:
            file = self.folder / entry.get("file")
            require(file.exists(), f"{entry.get('file')} is missing")
            if file.suffix == ".pvtu":
                sources = xml.etree.ElementTree.parse(file).getroot().findall("PUnstructuredGrid/Piece")
                pieces |= {file} | {file.parent / piece.get("Source") for piece in sources}
            else:
                pieces.add(file)
        require(pieces == set((self.folder / "solution").iterdir()), "solution/ has other files than solution.pvd")
        drawn = sorted(piece for piece in pieces if piece.suffix == ".vtu")
        for piece in drawn[::1 + len(drawn) // MOST_FRAMES]:
            self.check_frame(piece)
        times = [float(entry.get("timestep")) for entry in entries]
        require(times == sorted(times), "the time of frames goes back")
        require(not self.history or times[-1] == self.history[-1]["time"], "the last frame is not of the last state")

    @staticmethod
    def check_frame(piece):
        try:
            frame = vtu.Frame(piece)
        except SystemExit as fault:
            raise Wrong(f"{piece.name}: {fault}") from fault
        for fields in frame.arrays.values():
            for name, values in fields.items():
                for value in values:
                    numbers(value if isinstance(value, list) else [value], f"{name} of {piece.name}")

    def check_energy(self):
        """Neither does `dissipated` fall, nor does the energy rise by more than the work that was done, without a word."""
        largest = max(row["kinetic"] + row["elastic"] for row in self.history)
        summed = max(abs(row[column]) for row in self.history for column in ("total", "work", "dissipated", "potential"))
        require(min(row["kinetic"] for row in self.history) >= 0, "the kinetic energy is negative")
        if self.parameters["Corotation/Rotation"] == "gram-schmidt" or self.parameters["Time/Problem"] == "static":
            return
        gained = risen = 0.
        most_dissipated, start = 0., self.history[0]["total"] - self.history[0]["work"]
        for row in self.history:
            most_dissipated = max(most_dissipated, row["dissipated"])
            gained = max(gained, most_dissipated - row["dissipated"])
            risen = max(risen, row["total"] + row["dissipated"] - row["work"] - start)
        told = any(GAIN_IN_WORDS in warning for warning in self.summary["warnings"])
        bound = 1.001 * GAIN_WITH_WARNING * largest + ROUND_OFF * summed
        require(told or gained <= bound, f"the time stepping added {gained} J to a motion of {largest} J without a warning")
        require(told or risen <= bound, f"total + dissipated - work rose by {risen} J in a motion of {largest} J without a warning")

    def mass(self):
        """Of the tetrahedra of the first frame, at rest; 0 where they are not all there."""
        frames = list((self.folder / "solution").glob("frame_0000.vtu"))
        if not frames:
            return 0.
        frame = vtu.Frame(frames[0])
        vertex_mass = float(self.parameters["Material/Mass per vertex"])
        if vertex_mass > 0:
            return vertex_mass * len(frame.points)
        density = {}
        for material in filter(None, self.parameters["Material/By id"].split(";")):
            number, constants = material.split(":")
            density[int(number)] = float(constants.split(",")[2])
        total = 0.
        for cell, material in zip(frame.cells, frame.of_cells["material"]):
            places = [[x - u for x, u in zip(frame.points[point], frame.of_points["displacement"][point])] for point in cell]
            a, b, c = ([x - y for x, y in zip(place, places[0])] for place in places[1:])
            volume = abs(sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3))) / 6
            total += volume * density.get(int(material), float(self.parameters["Material/Density"]))
        return total

    def check_balance(self):
        """Of a body that is done, that has its weight alone and a probe `body` of all vertices: what holds it carries its weight."""
        loaded = any(self.parameters[entry] != "0; 0; 0" for entry in ("Loads/Body force", "Loads/Nodal force", "Loads/Traction",
                                                                       "Start/Displacement"))
        if loaded or self.parameters["Loads/Pressure"] != "0" or self.parameters["Mesh/Shape"] == "rectangle" or \
           not self.on("Output/History") or self.parameters["Probes/Regions"] != "body: 1" or not (mass := self.mass()):
            return
        last = self.table("probes.csv")[-1]
        size = max(abs(value) for row in self.table("probes.csv") for name, value in row.items() if ".f" in name)
        accuracy = max(1e-5, 100 * float(self.parameters["Time/Newton tolerance"]), 100 * float(self.parameters["Solver/Tolerance"]))
        for axis, gravity in zip("xyz", self.parameters["Loads/Gravity"].split(",")):
            weight = mass * float(gravity)
            out_of_balance = abs(last[f"body.f{axis}"] + weight)
            require(out_of_balance <= accuracy * (size + abs(weight)),
                    f"done, but out of balance by {out_of_balance} N of {size + abs(weight)} N")
