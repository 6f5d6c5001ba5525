"""Tables in LaTeX: booktabs, in a float across both columns."""

import re
import unicodedata

from app.study.table import UNDEFINED, Table, shown

_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': "''",
    "[": "{[}",  # a row that begins with one would be an argument of the \\ before it
    "]": "{]}",
    "*": "{*}",
    UNDEFINED: "--",
    "γ": r"$\gamma$",
    "δ": r"$\delta$",
}
LONGEST = 60
"""Maximum number of rows of a table that fits onto a page."""


def as_latex(table: Table, conditions: str) -> str:
    r"""Write a table as ASCII `table*`; needs \usepackage{booktabs} and \usepackage{graphicx}.

    Args:
        table: of `LONGEST` rows at most.
        conditions: sentence for below the table, after its note.
    """
    alignment = "".join("r" if column.form else "l" for column in table.columns)
    body = [[shown(c, row[c.key]) for c in table.columns] for row in table.rows]
    lines = [
        r"% Needs \usepackage{booktabs} and \usepackage{graphicx}.",
        r"\begin{table*}",
        r"\centering",
        rf"\caption{{{escaped(table.title)}}}",
        rf"\label{{tab:tofscope-{table.name.replace('_', '-')}}}",
        r"\footnotesize",
        r"\setlength{\tabcolsep}{3pt}",
        # Wide tables shrink to the text's width.
        r"\resizebox{\ifdim\width>\textwidth\textwidth\else\width\fi}{!}{%",
        rf"\begin{{tabular}}{{@{{}}{alignment}@{{}}}}",
        r"\toprule",
        *_group_lines(table),
        _line([column.title for column in table.columns]),
        r"\midrule",
    ]
    before = ""
    for row in body:
        first = row[0]
        # As in the paper: a gap between experiments, each named once.
        if before and first != before:
            lines.append(r"\addlinespace")
        lines.append(_line([first if first != before else "", *row[1:]]))
        before = first
    note = escaped(f"{table.note} {conditions}")
    return "\n".join(
        [
            *lines,
            r"\bottomrule",
            r"\end{tabular}}",
            r"\par\smallskip",
            rf"\parbox{{\textwidth}}{{\scriptsize {note}}}",
            r"\end{table*}",
            "",
        ]
    )


def _group_lines(table: Table) -> list[str]:
    if not any(title for title, _ in table.groups):
        return []
    cells, rules, column = [], [], 1
    for title, span in table.groups:
        cells.append(rf"\multicolumn{{{span}}}{{c}}{{{escaped(title)}}}" if title else "")
        if title:
            rules.append(rf"\cmidrule(lr){{{column}-{column + span - 1}}}")
        column += span
    return [" & ".join(cells) + r" \\", " ".join(rules)]


def _line(cells: list[str]) -> str:
    return " & ".join(map(_cell, cells)) + r" \\"


def _cell(text: str) -> str:
    """Cell of a table; a minus outside of mathematics would be a hyphen."""
    return r"$-$" + escaped(text[1:]) if re.match(r"-\d", text) else escaped(text)


def escaped(text: str) -> str:
    """Escape text for LaTeX, in ASCII: accents are dropped, other characters become ?."""
    return "".join(_SPECIAL.get(character) or _plain(character) for character in text)


def _plain(character: str) -> str:
    if character.isascii():
        return character if character.isprintable() else " "
    base = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return base or "?"
