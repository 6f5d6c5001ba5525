"""HTML of the study's report page, one file with its figure embedded."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from app.output.checks import GENERATOR
from app.study.table import Table, shown

_STYLE = """
:root { color-scheme: light dark; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem; }
p, li { max-width: 50rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13px; }
th, td { padding: .2rem .55rem; text-align: right; white-space: nowrap; }
th { vertical-align: bottom; font-weight: 600; white-space: normal; }
th.text, td.text { text-align: left; }
th.group { text-align: center; border-bottom: 1px solid; }
table { border-top: 2px solid; border-bottom: 2px solid; }
thead tr:last-child th { border-bottom: 1px solid; }
tr.next td { border-top: 1px solid #8886; }
td.paper, th.paper { color: #767676; font-weight: 400; }
.note { font-size: 13px; color: #767676; }
.simulated { padding: .5rem .8rem; border-left: 4px solid #d55e00; background: #d55e0018; }
code, pre { font-size: 13px; } pre { white-space: pre-wrap; overflow-wrap: anywhere; }
figure { margin: 0; } figure img { max-width: 100%; background: white; }
dt { font-weight: 600; } dd { margin: 0 0 .4rem 1rem; }
@media print { body { font-size: 11px; } }
"""


@dataclass(frozen=True)
class Section:
    """Section of the page: a heading and blocks of HTML."""

    heading: str
    blocks: Sequence[str]


def page(title: str, sections: Sequence[Section]) -> str:
    """A whole HTML document."""
    body = "".join(
        f"<section><h2>{escape(s.heading)}</h2>{''.join(s.blocks)}</section>\n" for s in sections
    )
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"{GENERATOR}"
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head>\n"
        f"<body><h1>{escape(title)}</h1>\n{body}</body></html>\n"
    )


def paragraph(text: str, style: str = "") -> str:
    """A paragraph of plain text."""
    return f'<p class="{style}">{escape(text)}</p>' if style else f"<p>{escape(text)}</p>"


def items(texts: Sequence[str]) -> str:
    """A bullet list of plain texts."""
    return "<ul>" + "".join(f"<li>{escape(text)}</li>" for text in texts) + "</ul>"


def terms(texts: dict[str, str]) -> str:
    """Definition list of {term: text}."""
    return (
        "<dl>" + "".join(f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in texts.items())
    ) + "</dl>"


def command(text: str) -> str:
    """A command to type."""
    return f"<pre>{escape(text)}</pre>"


def picture(png: bytes, text: str) -> str:
    """A PNG embedded in the page, with its alternative text."""
    data = base64.b64encode(png).decode()
    return f'<figure><img alt="{escape(text)}" src="data:image/png;base64,{data}"></figure>'


def links(paths: Sequence[str]) -> str:
    """Links to files, relative to the page."""
    found = ", ".join(f'<a href="{escape(path)}">{escape(path)}</a>' for path in paths)
    return f'<p class="note">{found}</p>'


def folded(heading: str, block: str) -> str:
    """A block that is folded until clicked."""
    return f"<details><summary>{escape(heading)}</summary>{block}</details>"


def table(content: Table) -> str:
    """A table with its note below."""
    head = "".join(
        f'<th class="{"text" if not c.form else "paper" if c.from_paper else ""}">'
        f"{escape(c.title)}</th>"
        for c in content.columns
    )
    groups = "".join(
        f'<th colspan="{span}"{" class=group" if title else ""}>{escape(title)}</th>'
        for title, span in content.groups
    )
    above = f"<tr>{groups}</tr>" if any(title for title, _ in content.groups) else ""
    rows, before = [], None
    for row in content.rows:
        first = row[content.columns[0].key]
        style = ' class="next"' if before not in (None, first) else ""
        cells = "".join(
            f'<td class="{"text" if not c.form else "paper" if c.from_paper else ""}">'
            f"{escape(shown(c, row[c.key]))}</td>"
            for c in content.columns
        )
        rows.append(f"<tr{style}>{cells}</tr>")
        before = first
    return (
        f'<div class="scroll"><table><thead>{above}<tr>{head}</tr></thead>'
        f"<tbody>{''.join(rows)}</tbody></table></div>{paragraph(content.note, 'note')}"
    )
