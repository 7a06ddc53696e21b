"""Values for the entries of parameter files, each of the kind that the program says of it: most of them are accepted."""

import json
import re

import runner
from mutations import ParameterText

SPECIAL = [0, 1, -1, 2, 0.5, 1e-300, 1e-30, 1e-12, 1e-6, 1e6, 1e12, 1e30, 1e300, -1e6, 0.499999, 0.999999]
WHOLE = [0, 1, 1, 2, 3, 4, 5, 7, 10, 30, -1, 1000, 2147483647, 4294967295]
NAMES = ["tip", "wall", "low", "motion2", "x", "p_1", "a b"]
CONDITIONS = ["x < {a}", "y > {a}", "z > {a}", "y < 1e-9", "x > 0 && z > 0", "x^2 + y^2 < {a}", "1", "0", "x == 0 || y == 0", "x*{a} > y"]
IN_SPACE = ["{n}", "{n}", "{n}*x", "{n}*y", "{n}*x*y", "{n}*(x - {a})^2", "{n}*sin({k}*y)", "{n}*exp({k}*z)", "if(x > {a}, {n}, 0)",
            "sqrt(x - {a})", "{n}/x"]
IN_TIME = ["{n}*t", "{n}*sin({k}*t)", "{n}*min(t/{a}, 1)", "if(t > {a}, {n}, 0)", "if(t > {a}, 1/0, 0)", "{n}*exp({k}*t)", "{n}*t*x",
           "{n}*cos({k}*t + y)", "sqrt({a} - t)", "{n}*(t < {a})", "log(t)"]
MAPS = ["x; y; z", "{a}*x; y; z", "x + {a}*y; y; z", "-x; y; z", "x; y; z + {a}*x^2", "x*cos({a}*y); x*sin({a}*y); z", "x; y; 0",
        "{n}*x; {n}*y; {n}*z", "x + {a}; y; z"]


def kinds():
    """For each "Section/Entry" its default and the words for its range."""
    status, text, _ = runner.run("--print-parameters", "json")
    runner.check(status == 0, "--print-parameters json")
    return {f"{section}/{name}": (entry["default_value"], entry["documentation"].split("Range: ")[-1].rstrip("."))
            for section, entries in json.loads(text).items() for name, entry in entries.items()}


class EntryValues:
    """Draws values."""

    def __init__(self, chance, known, used):
        """known: as kinds() gives it. used: for each entry the values that scenes set."""
        self.chance = chance
        self.known = known
        self.used = used
        self.text = ParameterText(chance, [], {name.split("/")[-1]: values for name, values in used.items()})

    def value(self, entry, now):
        """A value for an entry that has the value `now`, or an empty text."""
        default, kind = self.known[entry]
        how = self.chance.random()
        if how < 0.03:
            return re.sub("[\0\n\x1f]", " ", self.text.value(entry.split("/")[-1]))
        if how < 0.2 and self.used.get(entry):
            return self.chance.choice(self.used[entry])
        if how < 0.25:
            return default
        special = {"Mesh/Map": self.map, "Motion/Displacement": self.motion, "Mesh/Boundary regions": lambda: self.by_id(self.condition),
                   "Material/By id": lambda: self.by_id(self.material), "Mesh/File": self.file,
                   "Mesh/Refine": lambda: self.chance.choice(["1 by energy", "2 by energy", "1 by tip.uz", "2 by x", "energy", ""]),
                   "Mesh/Refine region times": lambda: self.chance.choice(["1", "2", "0", "100"]),
                   "Mesh/Refine region size": lambda: self.chance.choice(["0", "0.5", "1", "-1", "1e30"]),
                   "Mesh/Refine most cells": lambda: self.chance.choice(["1", "500", "5000"])}
        drawn = special.get(re.sub(r"Motion \d", "Motion", entry)) or self.of_kind(kind, now or default)
        return drawn()

    def of_kind(self, kind, now):
        """A function that draws a value of a range in words."""
        if kind.startswith("one of "):
            return lambda: self.chance.choice(kind.removeprefix("one of ").split(", "))
        if "expression of names" in kind or kind.startswith(("Any", "a file", "Section/", "as one of")):
            return lambda: self.text.value()
        for beginning, draw in {"boundary ids": self.ids, "an expression": self.expression, "three expressions": self.vector,
                                "as Of in": self.selection, "vertex and": self.selection, "name: x, y, z": lambda: self.named(self.point),
                                "name: boundary id": lambda: self.named(self.id),
                                "name: expression": lambda: self.named(self.condition)}.items():
            if kind.startswith(beginning):
                return draw
        counts = {"two values": [2], "three values": [3], "whole numbers": [0, 1, 2, 3], "thicknesses": [0, 1, 2, 3], "numbers": [1, 2]}
        count = next((counts[words] for words in counts if kind.startswith(words)), None)
        if count:
            parts = (now.split(",") + [""] * 3)[:self.chance.choice(count)]
            return lambda: ", ".join(self.one(kind, part.strip()) for part in parts)
        return lambda: self.one(kind, now)

    def one(self, kind, now):
        if "whole number" in kind:
            return str(self.chance.choice(WHOLE))
        return self.number(now, above="greater" in kind)

    def number(self, now="", above=False):
        """Mostly some powers of ten from what it is now, or from one."""
        if self.chance.random() < 0.2:
            return repr(self.chance.choice(SPECIAL))
        try:
            size = float(now) or 1.
        except ValueError:
            size = 1.
        width = self.chance.choice([0.3, 1, 2, 4, 6, 12])
        value = size * 10**self.chance.uniform(-width, width)
        return f"{value if above or self.chance.random() < 0.7 else -value:.4g}"

    def fill(self, pattern):
        """The pattern with numbers for {a} (between 0 and 1.5), {k} (of either sign) and {n} (any)."""
        draw = {"a": lambda: f"{self.chance.uniform(0, 1.5):.3g}", "k": lambda: f"{self.chance.uniform(-50, 50):.3g}", "n": self.number}
        return re.sub(r"\{(\w)\}", lambda place: draw[place[1]](), pattern)

    def condition(self):
        return self.fill(self.chance.choice(CONDITIONS))

    def expression(self):
        if self.chance.random() < 0.05:
            return self.text.expression()
        return self.fill(self.chance.choice(self.chance.choice([IN_SPACE, IN_SPACE, IN_TIME, CONDITIONS])))

    def component(self):
        return "0" if self.chance.random() < 0.4 else self.fill(self.chance.choice(IN_SPACE + IN_TIME))

    def vector(self):
        third = self.chance.choice(["0", self.component()])
        return "; ".join([self.component(), self.component(), third])

    def motion(self):
        return "; ".join(self.chance.choice(["free", "0", self.component(), self.fill(f"{self.chance.uniform(-1, 1):.3g}*min(t/{{a}}, 1)")])
                         for _ in range(3))

    def map(self):
        return self.fill(self.chance.choice(MAPS))

    def id(self):
        return str(self.chance.choice([0, 1, 2, 3, 4, 5, 7, 99]))

    def ids(self):
        return ", ".join(self.id() for _ in range(self.chance.choice([0, 1, 1, 2, 3])))

    def point(self):
        place = ", ".join(f"{self.chance.uniform(-0.5, 1.5):.3g}" for _ in range(3))
        return self.chance.choice([place, f"vertex {self.chance.choice(WHOLE)}"])

    def named(self, draw):
        return "; ".join(f"{name}: {draw()}" for name in self.chance.sample(NAMES, self.chance.choice([0, 1, 1, 2])))

    def selection(self):
        return self.chance.choice(["", "all", f"vertex {self.chance.choice(WHOLE)}", f"nearest to {self.point()}", f"boundary {self.ids()}",
                                   f"region {self.condition()}"])

    def material(self):
        return f"{self.number('1e6', above=True)}, {self.chance.uniform(-1, 0.5):.3g}, {self.number('1000', above=True)}"

    def by_id(self, draw):
        return "; ".join(f"{self.id()}: {draw()}" for _ in range(self.chance.choice([0, 1, 1, 2])))

    def file(self):
        return "../meshes/" + self.chance.choice(sorted(path.name for path in (runner.DATA / "meshes").iterdir()) + ["none.msh"])
