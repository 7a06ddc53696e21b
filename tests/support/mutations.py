"""Changes of texts, of parameter files among them, that look for what a program does with damaged input."""

import re

import runner

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
