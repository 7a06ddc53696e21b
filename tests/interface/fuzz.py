"""Damaged parameter files, meshes and measurements: supple --check ends with exit status 0 or 1, with a message, soon.

fuzz.py SUPPLE [--driver SUPPLE_CHECK] [--part parameters|meshes|measurements] [--count N | --minutes N] [--seed N]
        [--only N] [--keep FOLDER] [--messages FILE]

The same seed gives the same mutants; --only N repeats one. The driver is quicker, for it starts once. What fails is kept
in the folder, or else in a temporary one.
"""

import argparse
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

# Of computing: on a busy machine the clock says little. A check takes .3 s, with sanitizers some seconds.
SECONDS = 30
SECONDS_SANITIZED = 300
MEMORY = 8 * 2**30
LONGEST_MESSAGE = 6000
PARTS = ("parameters", "meshes", "measurements")

# These studies look through many or large scenes.
SLOW = {"cantilever-bending", "elastica", "lame-cylinder", "lame-sphere", "bar-large", "bar-small", "vein", "fit-3d", "soft-bar",
        "order", "stiff-bar", "needle"}

NUMBERS = ["0", "-0.0", "1", "-1", "2", "1e-320", "1e-30", "1e30", "1e308", "-1e308", "1e400", "nan", "-nan", "inf", "-inf",
           "2147483647", "2147483648", "-2147483649", "4294967295", "4294967296", "99999999999999999999", "0x10", "1e", "1.5.2",
           "--3", "1,5", "1e5", "100000", "0.5", "3.7", "١", "1e-5", "0.1", "+7", " 7 ", "1_000"]
WORDS = ["many", "true", "none", "", "-", "=", "set", "end", "subsection", "#", ";", ":", ",", "''", "\"", "\\", "|", "(", ")", "((",
         "x", "t", "1/0", "log(-1)", "sqrt(-1)", "x^x^x^x", "1/(x-x)", "if(x", "rand()", "sin", "x; y; z", "y > 11.9 && (", "tip: 2, 0, 2",
         "tip: 2, 0", ": ;", "a: b: c", "1: 2: 3", "../..", "/dev/null", "/", ".", "%s%n", "$HOME", "ä", "\ufeff", "\u202e"]
BYTES = [b"\0", b"\r", b"\xff", b"\xfe\xff", b"\x1b[2J", b"\xc3", b"\t", b"\x0b", b"\x80" * 9]
REPORT = re.compile("ERROR: AddressSanitizer|ERROR: LeakSanitizer|runtime error:|Assertion .* failed|__n < this->size")
# What the standard library says of a mistake is no help to anybody.
RAW = re.compile(r"map::at|\bsto[iuld]+\b|_M_|basic_string|regex_error|vector::|bad_alloc|std::|Exc[A-Z]|terminate called|Additional information")


def entries():
    """Section, name and default of all that can be set."""
    status, text, _ = runner.run("--print-parameters")
    runner.check(status == 0, "--print-parameters")
    found, section = [], ""
    for line in text.splitlines():
        line = line.removeprefix("# ") if re.match(r"# (subsection|  set|end)", line) else line
        if match := re.match(r"subsection (.*)", line):
            section = match[1]
        elif match := re.match(r"  set (.*?)\s*= ?(.*)", line):
            found.append((section, match[1], match[2]))
    return found


class Text:
    """Changes of a text, each of which takes the text as bytes and gives another one."""

    def __init__(self, chance):
        self.chance = chance

    def span(self, data):
        """Two places in the text, mostly close to one another."""
        first = self.chance.randrange(len(data) + 1)
        return first, min(len(data), first + self.chance.choice([0, 1, 2, 5, 20, 100, len(data)]))

    def number(self):
        return self.chance.choice([self.chance.choice(NUMBERS), str(self.chance.randrange(-3, 40)),
                                   repr(self.chance.uniform(-1, 1) * 10**self.chance.randrange(-20, 20))]).encode()

    def flip(self, data):
        data = bytearray(data)
        for _ in range(self.chance.choice([1, 1, 1, 2, 8, 64])):
            if data:
                data[self.chance.randrange(len(data))] ^= 1 << self.chance.randrange(8)
        return bytes(data)

    def truncate(self, data):
        return data[:self.chance.randrange(len(data) + 1)]

    def delete(self, data):
        first, last = self.span(data)
        return data[:first] + data[last:]

    def duplicate(self, data):
        first, last = self.span(data)
        return data[:last] + data[first:last] * self.chance.choice([1, 1, 2, 50]) + data[last:]

    def insert(self, data):
        place = self.chance.randrange(len(data) + 1)
        text = self.chance.choice([self.chance.choice(BYTES), self.chance.choice(WORDS).encode(), self.number()])
        return data[:place] + text + data[place:]

    def replace_number(self, data):
        return self.replace(rb"-?\d+\.?\d*(?:e-?\d+)?", data, self.number())

    def replace_word(self, data):
        return self.replace(rb"[A-Za-z]\w*|-?\d[\d.e]*", data, self.chance.choice(WORDS).encode())

    def delete_brace(self, data):
        return self.replace(rb"[()\[\]{}$;:,=]", data, b"")

    def replace(self, pattern, data, text):
        places = list(re.finditer(pattern, data))
        if not places:
            return data + text
        place = self.chance.choice(places)
        return data[:place.start()] + text + data[place.end():]

    def swap_lines(self, data):
        lines = data.split(b"\n")
        i, j = (self.chance.randrange(len(lines)) for _ in range(2))
        lines[i], lines[j] = lines[j], lines[i]
        return b"\n".join(lines)

    def delete_line(self, data):
        lines = data.split(b"\n")
        del lines[self.chance.randrange(len(lines))]
        return b"\n".join(lines)

    def duplicate_line(self, data):
        lines = data.split(b"\n")
        place = self.chance.randrange(len(lines))
        return b"\n".join(lines[:place] + [lines[place]] * self.chance.choice([2, 2, 3, 500]) + lines[place + 1:])

    def long_line(self, data):
        place = self.chance.choice([0, len(data), self.chance.randrange(len(data) + 1)])
        piece = self.chance.choice([b"a", b"1,", b"(", b"x+", b" ", b"1 ", b"#", b"a: 1; ", b"\\\n", b"-"])
        return data[:place] + piece * self.chance.choice([300, 20000, 300000]) + data[place:]

    def mutate(self, data, changes):
        for _ in range(self.chance.choice([1, 1, 1, 2, 3, 6])):
            data = self.chance.choice(changes)(data)
        return data

    def anywhere(self):
        return [self.flip, self.truncate, self.delete, self.duplicate, self.insert, self.replace_number, self.replace_number,
                self.replace_number, self.replace_word, self.delete_brace, self.swap_lines, self.delete_line, self.duplicate_line,
                self.long_line]


class ParameterText(Text):
    """Changes that know what a parameter file is."""

    def __init__(self, chance, known, values):
        super().__init__(chance)
        self.known = known      # (section, name, default) of all entries
        self.values = values    # that the scenes set, for each name

    def expression(self, depth=0):
        if depth > 3 or self.chance.random() < 0.3:
            return self.chance.choice(["x", "y", "z", "t", "pi", "0", "1", "-1", "1e300", "0.5", "q", "1e-300"])
        inner = [self.expression(depth + 1) for _ in range(3)]
        return self.chance.choice(["{0} + {1}", "{0}*{1}", "{0}/{1}", "{0}^{1}", "({0} < {1})", "{0} && {1}", "sqrt({0})", "log({0})", "sin({0})",
                                   "if({0}, {1}, {2})", "min({0}, {1})", "-{0}", "({0})", "{0} > {1} || {2}", "rand_seed({0})", "tan({0}"]).format(*inner)

    def value(self, name=""):
        """Any value, or one that almost fits the entry."""
        kind = self.chance.randrange(9)
        if kind == 0:
            return self.chance.choice(WORDS)
        if kind == 1:
            count = self.chance.choice([1, 2, 3, 3, 3, 4, 50])
            return self.chance.choice([", ", "; ", " "]).join(self.number().decode() for _ in range(count))
        if kind == 2:
            return "; ".join(self.expression() for _ in range(self.chance.choice([1, 3])))
        if kind == 3:
            depth = self.chance.choice([3, 100, 900])
            return self.chance.choice(["(" * depth, "(" * depth + "x" + ")" * depth, "-" * depth + "1", "sin(" * depth, "1+" * depth + "1"])
        if kind == 4:
            return self.number().decode()
        # What a scene says there, or elsewhere, with a change.
        value = self.chance.choice(self.values.get(name) or self.chance.choice(list(self.values.values())))
        change = self.chance.choice([self.replace_number, self.replace_number, self.replace_word, self.delete_brace, self.duplicate, self.insert])
        return change(value.encode()).decode(errors="replace").replace("\n", " ")

    def set_value(self, data):
        """Another value for an entry the scene has."""
        places = list(re.finditer(rb"(?m)^\s*set ([^=\n]*?)\s*=(.*)$", data))
        if not places:
            return self.add_entry(data)
        place = self.chance.choice(places)
        value = self.value(place[1].decode(errors="replace"))
        return data[:place.start(2)] + b" " + value.encode() + data[place.end(2):]

    def add_entry(self, data):
        """An entry that the scene has not, or had otherwise. Studies and identifications have a section alone."""
        alone = [section for section in ("Study", "Identification") if f"subsection {section}\n".encode() in data]
        section, name, default = self.chance.choice([entry for entry in self.known if entry[0] in alone or
                                                     not alone and entry[0] not in ("Study", "Identification")])
        value = self.chance.choice([default, self.value(name), self.value(name)])
        return data + f"\nsubsection {section}\n  set {name} = {value}\nend\n".encode()

    def unknown(self, data):
        return data + self.chance.choice([b"\nsubsection Mesh\n set Colour = blue\nend\n", b"\nset Colour = blue\n", b"\nsubsection Paint\nend\n",
                                          b"\nsubsection Study\n set Scene = mutant.prm\nend\n", b"\ninclude mutant.prm\n",
                                          b"\nsubsection Mesh\nsubsection Mesh\nset Scale = 1\nend\nend\n"])

    def nest(self, data):
        depth = self.chance.choice([1, 2, 1000, 20000])
        return b"subsection Mesh\n" * depth + data + b"end\n" * self.chance.choice([0, depth])

    def mutate_all(self, data):
        return self.mutate(data, self.anywhere() + 12 * [self.set_value, self.add_entry] + [self.unknown, self.nest])


class Binary(Text):
    """Changes of the numbers in a binary file."""

    def overwrite(self, data):
        size = self.chance.choice([4, 8])
        if len(data) < size:
            return data
        place = self.chance.randrange(len(data) - size + 1)
        number = self.chance.choice([0, 1, 2**31 - 1, 2**31, 2**32 - 1, 2**63, 2**64 - 1, 0x7ff0000000000000, 0x7ff8000000000000, 0x7f7fffff,
                                     self.chance.randrange(2**20)])
        return data[:place] + (number % 2**(8 * size)).to_bytes(size, self.chance.choice(["little", "big"])) + data[place + size:]


class Corpus:
    """Copies of the scenes with their meshes, in which mutants are put beside what they name."""

    def __init__(self, folder):
        self.folder = folder
        shutil.copytree(runner.ROOT / "parameters", folder / "parameters")
        self.scenes = [path for path in sorted((folder / "parameters").rglob("*.prm")) if path.stem not in SLOW]
        self.meshes = sorted((runner.DATA / "meshes").iterdir())
        self.known = entries()
        self.values = {}
        for path in self.scenes:
            for match in re.finditer(r"set ([^=\n]*?)\s*= *([^#\n]*)", path.read_text()):
                self.values.setdefault(match[1], []).append(match[2])

    def mutant(self, part, seed, number):
        """Writes a mutant; gives the scene to check and the file that is damaged."""
        chance = random.Random(f"{part} {seed} {number}")
        if part == "parameters":
            source = chance.choice(self.scenes)
            target = scene = source.with_name("mutant.prm")
            data = ParameterText(chance, self.known, self.values).mutate_all(source.read_bytes())
        elif part == "meshes":
            source = chance.choice(self.meshes)
            target = self.folder / ("mutant" + source.suffix)
            text = Binary(chance)
            overwrites = [text.overwrite] * (16 if "binary" in source.name else 1)
            data = text.mutate(source.read_bytes(), text.anywhere() + overwrites)
            scene = self.folder / "scene.prm"
            scene.write_text(f"subsection Mesh\n set Shape = file\n set File = {target.name}\nend\n"
                             "subsection Constraints\n set Clamped region = x < 0.1\nend\n")
        else:
            skin = self.folder / "parameters" / "skin"
            target, scene = skin / "mutant.csv", skin / "scene.prm"
            text = Text(chance)
            data = text.mutate((skin / "fingertip.csv").read_bytes(), text.anywhere())
            scene.write_text((skin / "fit-plane-strain.prm").read_text().replace("fingertip.csv", "mutant.csv"))
        target.write_bytes(data)
        return scene, target


class Checker:
    """Runs supple --check: the program itself, or its driver, which starts once."""

    def __init__(self, driver, folder, messages):
        self.sanitized = b"__asan_init" in pathlib.Path(runner.SUPPLE).read_bytes()
        self.seconds = SECONDS_SANITIZED if self.sanitized else SECONDS
        self.driver = driver
        self.errors = folder / "stderr"
        self.server = None
        self.messages = open(messages or os.devnull, "w")
        self.refused = 0

    def limit_memory(self):
        if not self.sanitized:    # these take terabytes of addresses for themselves
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

    def limit(self):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (self.seconds, self.seconds))
        self.limit_memory()

    def by_program(self, scene):
        """Exit status, or the negative signal, and standard error."""
        done = subprocess.run([runner.SUPPLE, "--check", scene.name], cwd=scene.parent, env=runner.ENVIRONMENT, capture_output=True,
                              stdin=subprocess.DEVNULL, preexec_fn=self.limit)
        return done.returncode, done.stderr

    def by_driver(self, scene):
        if not self.server:
            self.server = subprocess.Popen([self.driver, str(self.seconds)], env=runner.ENVIRONMENT, stdin=subprocess.PIPE,
                                           stdout=subprocess.PIPE, text=True, preexec_fn=self.limit_memory)
        self.errors.write_bytes(b"")
        self.server.stdin.write(f"{scene.parent}\t{scene.name}\t{self.errors}\n")
        self.server.stdin.flush()
        return os.waitstatus_to_exitcode(int(self.server.stdout.readline())), self.errors.read_bytes()

    def complaint(self, scene):
        """What is wrong with what supple says of this scene, or nothing."""
        status, error = self.by_driver(scene) if self.driver else self.by_program(scene)
        error = error.decode(errors="replace")
        self.messages.write(error)
        self.refused += status == 1
        if REPORT.search(error):
            return "report of a sanitizer\n" + error[:4000]
        if status in (-signal.SIGKILL, -signal.SIGXCPU):
            return f"no end in {self.seconds} s of computing"
        if status not in (0, 1):
            return f"exit status {status}\n{error[:2000]}"
        if status == 1 and not re.match(r"supple: \S", error):
            return "exit status 1 without a message\n" + error[:2000]
        if status == 1 and RAW.search(error):
            return "the message is not in words\n" + error[:2000]
        if status == 1 and len(error) > LONGEST_MESSAGE:
            return f"the message has {len(error)} letters\n{error[:300]}"
        return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("supple")
    parser.add_argument("--part", choices=PARTS)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--minutes", type=float)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    parser.add_argument("--driver")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--messages", type=pathlib.Path, help="file for all messages, to be read")
    options = parser.parse_args()

    corpus = Corpus(pathlib.Path(tempfile.mkdtemp(prefix="supple-fuzz-")))
    checker = Checker(options.driver, corpus.folder, options.messages)
    kept = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="supple-fuzz-failed-"))
    kept.mkdir(parents=True, exist_ok=True)
    parts = [options.part] if options.part else list(PARTS)
    started, tried, failed = time.monotonic(), 0, 0
    number = options.only or 0
    while True:
        for part in parts:
            scene, target = corpus.mutant(part, options.seed, number)
            wrong = checker.complaint(scene)
            tried += 1
            if wrong:
                failed += 1
                copy = kept / f"{part}-{options.seed}-{number}{target.suffix}"
                shutil.copy(target, copy)
                copy.with_name(copy.name + ".txt").write_text(f"{target.parent.name}\n{wrong}\n")
                print(f"{part}, seed {options.seed}, number {number} ({target.parent.name}, kept as {copy}): {wrong}", flush=True)
        number += 1
        if options.minutes and number % 1000 == 0:
            print(f"{tried} mutants in {time.monotonic() - started:.0f} s", flush=True)
        enough = time.monotonic() - started > 60 * options.minutes if options.minutes else number >= options.count
        if enough or options.only is not None:
            break
    print(f"{tried} mutants in {time.monotonic() - started:.0f} s: {checker.refused} refused, {failed} failed")
    shutil.rmtree(corpus.folder)
    sys.exit(failed > 0)


main()
