"""Finds the places where a source can be mutated by one step, and writes the source with all mutants in it; a number selects one at run time.

A mutant is text inserted before and after a place: `a < b` becomes `a < Less<17>{} < b`. The source format tells operators from
brackets and references: only a binary operator has a space on both sides. Constant expressions are not changed.
"""
import bisect
import re
from dataclasses import dataclass

COMPARISONS = {"<": "Less", "<=": "LessEqual", ">": "Greater", ">=": "GreaterEqual", "==": "Equal", "!=": "NotEqual"}
SUMS = {"+": "Plus", "-": "Minus"}
BECOMES = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+"}
NAMES = "strata_mutants::"

STRINGS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![\w])\'(?:\\.|[^\'\\\n])\'|^[ ]*#[^\n]*(?:\\\n[^\n]*)*', re.S | re.M)
UNTOUCHED = re.compile(r"\b(?:requires|concept|static_assert|template|consteval|using)\b|operator|constexpr auto enum_values|\bHWY_\w+")
BINARY = re.compile(r"(?<= )(<=|>=|==|!=|<|>|\+|-)(?= )")
NUMBER = re.compile(r"(?<![\w.'])(?<![pPeE][+-])(?:0x[0-9a-fA-F']+|\d[\d']*(?:\.\d*)?)(?:[uUlLzZ]*|f)(?![\w.'])")
ENUMERATOR = re.compile(r"\b([A-Z]\w*)::([a-z_]\w*)\b(?!\s*[<(:])")
CONDITION = re.compile(r"\bif \(")
# An assignment or a call that is a statement of its own. Two words before the operator are a declaration.
STATEMENT = re.compile(r"^( *)((?:\+\+|--)[\w.\[\]()>-]+|([\w.:>\[\]()+-][\w.:>\[\]()+ -]*?)(?: [-+*/|&^]?=| <<=| >>=) [^;{}]*|([a-z_][\w.:>-]*)\([^;{}]*\));$", re.M)
NOT_DROPPED = re.compile(r"^(?:return|if|for|while|else|case|assert|static_assert|static_cast|co_\w+|throw|delete)\b|[\w>\])] +\w")
NO_STATEMENT = re.compile(r"= (?:default|delete|0)$")


@dataclass
class Place:
    kind: str  # comparison, sum, operand, constant, enumerator, condition, statement
    file: str
    begin: int
    end: int
    change: str  # for the report
    prefix: str  # with {n} for the mutant's number
    suffix: str
    line: int = 0
    number: int = 0


def masked(text):
    """The text with comments and directives blanked and strings replaced by words; all other characters keep their positions."""
    return STRINGS.sub(lambda m: re.sub(r"[^\n]", "s" if m.group()[0] in "\"'" else " ", m.group()), text)


def enums_of(texts):
    """{enum: [enumerators]} of all scoped enums whose values are numbered implicitly."""
    found = {}
    for text in texts:
        for name, body in re.findall(r"enum class (\w+)[^{;]*\{([^}]*)\}", masked(text)):
            values = [v.strip() for v in body.split(",") if v.strip()]
            if len(values) > 1 and all(re.fullmatch(r"\w+", v) for v in values):
                found[name] = values
    return found


def operand_ends(code, at, step):
    """The end of an operand of the && or || at `at`, on one side."""
    depth, i = 0, at
    opening, closing = ("([{", ")]}") if step > 0 else (")]}", "([{")
    while 0 <= i < len(code):
        c = code[i]
        if c in opening:
            depth += 1
        elif c in closing:
            if depth == 0:
                break
            depth -= 1
        elif depth == 0:
            if c in ";,?" or (c == ":" and code[i - 1] == " " and code[i + 1] == " "):
                break
            if code[i:i + 2] in ("&&", "||") and code[i - 1] == " ":
                break
            if c == "=" and code[i - 1] in " +-*/%|&^" and code[i + 1] in " \n":
                break
        i += step
    return i


def operands(code):
    for found in re.finditer(r"(?<= )(&&|\|\|)(?=[ \n])", code):
        before = operand_ends(code, found.start() - 1, -1) + 1
        before += re.match(r"[&|= \n]*(?:return\b)?\s*", code[before:]).end()
        yield found.group(), before, len(code[:found.start()].rstrip())
        behind = operand_ends(code, found.end(), 1)
        start = found.end() + re.match(r"\s*", code[found.end():]).end()
        yield found.group(), start, len(code[:behind].rstrip())


def is_whole(operand):
    """False for half of a pair of brackets: a comma between template arguments looks like the end of an operand."""
    brackets = re.sub(r"->| <=?(?= )| >=?(?= )|<<|>>", "", operand)
    pairs = all(brackets.count(a) == brackets.count(b) for a, b in ("()", "[]", "<>"))
    return bool(operand) and pairs and not re.search(r"\.\.\.|[{}]|\[\[", operand)


def closing(code, at):
    """The position where the bracket opened before `at` is closed."""
    depth = 1
    while depth > 0:
        depth += {"(": 1, ")": -1}.get(code[at], 0)
        at += 1
    return at - 1


def statement_end_before(code, at):
    return code[:at].rstrip()[-1:] in (";", "{", "}", ")", "")


def places_in(file, text, enums, is_kernel):
    code = masked(text)
    lines = [0] + [m.end() for m in re.finditer("\n", text)]
    barred = [bool(UNTOUCHED.search(code[a:b])) for a, b in zip(lines, lines[1:] + [len(text)])]
    for block in re.finditer(r"= requires\(.*?\n\};", code, re.S):
        for line in range(bisect.bisect_right(lines, block.start()) - 1, bisect.bisect_right(lines, block.end())):
            barred[line] = True
    line_of = lambda at: bisect.bisect_right(lines, at)
    found, seen = [], set()

    def add(kind, begin, end, change, prefix, suffix):
        if not barred[line_of(begin) - 1] and (kind, begin, end) not in seen:
            seen.add((kind, begin, end))
            found.append(Place(kind, file, begin, end, change, prefix, suffix, line_of(begin)))

    for m in BINARY.finditer(code):
        name = COMPARISONS.get(m[1]) or SUMS[m[1]]
        kind = "comparison" if m[1] in COMPARISONS else "sum"
        if not is_kernel and code[m.start() - 2] not in "(,=<>?:&|{[" and not code[:m.start()].endswith("return "):
            add(kind, m.start(), m.start(), f"{m[1]} becomes {BECOMES[m[1]]}", f"{m[1]} {NAMES}{name}<{{n}}>{{{{}}}} ", "")
    for operator, begin, end in operands(code):
        operand = code[begin:end]
        if not is_whole(operand):
            continue
        neutral = ("(", " || (") if operator == "&&" else ("(!", " && (")
        add("operand", begin, end, f"without {' '.join(operand.split())[:60]} of {operator}",
            f"{neutral[0]}{NAMES}is<{{n}}>(){neutral[1]}", "))")
    for m in NUMBER.finditer(code):
        before = code[:m.start()].rstrip()[-1:]
        if before == "-" or code[m.end():m.end() + 1] == "_":
            continue
        add("constant", m.start(), m.end(), f"{m[0]} becomes one more", f"{NAMES}one_more<{{n}}>(", ")")
    for m in ENUMERATOR.finditer(code):
        values = enums.get(m[1])
        if values and m[2] in values:
            qualified = re.search(r"[\w:]*$", code[:m.start()])[0]
            begin = m.start() - len(qualified)
            nearest = values[(values.index(m[2]) + 1) % len(values)]
            add("enumerator", begin, m.end(), f"{m[2]} becomes {nearest}", f"{NAMES}another<{{n}}, {len(values)}>(", ")")
    for m in CONDITION.finditer(code):
        end = closing(code, m.end())
        if not re.search(r";| = ", code[m.end():end]):
            add("condition", m.end(), end, "negated", f"{NAMES}negated<{{n}}>(", ")")
    for m in STATEMENT.finditer(code):
        left = m[3] or m[4] or ""
        if statement_end_before(code, m.start(2)) and not NOT_DROPPED.search(left) and not NO_STATEMENT.search(m[2]) and m[2].count("(") == m[2].count(")"):
            add("statement", m.start(2), m.end(), "dropped", f"{{{{ if (!{NAMES}is<{{n}}>()) ", " }")
    return found


def with_changes(text, places):
    """The source with all mutants in it. Of two that begin at the same position the longer one is outside."""
    inserted = []
    for p in places:
        inserted.append((p.begin, 1, -(p.end - p.begin), p.prefix.format(n=p.number)))
        if p.suffix:
            inserted.append((p.end, 0, p.end - p.begin, p.suffix))
    inserted.sort(key=lambda entry: entry[:3])
    parts, last = [], 0
    for at, _, _, what in inserted:
        parts += [text[last:at], what]
        last = at
    return f'#include "mutants/mutant.h"\n#line 1\n' + "".join(parts) + text[last:]
