import re
import shutil
import subprocess
from pathlib import Path

import pytest

from app.study.latex import as_latex, escaped
from app.study.paper_tables import paper_tables
from app.study.table import Column, Table
from tests.app.study.made import PLAN, good, made

NASTY = '50% of a_b & c#d $x$ {y} ~z^2 \\end{table} [1] * "q" <|> Größe 距離 γ δ\n'
HARD = Table(
    "hard_case",
    NASTY,
    NASTY,
    (Column("name", NASTY), Column("a", "a_1", ".2f", "both"), Column("b", "b", ".2f", "both")),
    ({"name": NASTY, "a": 1.0, "b": None}, {"name": "[x]", "a": None, "b": -2.0}),
)


def test_text_becomes_ascii_that_latex_shows_as_it_is():
    assert escaped("a_b & 5 %") == r"a\_b \& 5 \%"
    assert escaped("\\{}") == r"\textbackslash{}\{\}"
    assert escaped("Größe – δ") == r"Gro?e -- $\delta$"
    assert escaped(NASTY).isascii()
    assert "\n" not in escaped(NASTY)


@pytest.mark.parametrize("table", [HARD, *paper_tables(PLAN, [made(metrics=good(6.0, 0.03))])])
def test_every_line_has_as_many_cells_as_there_are_columns_and_braces_match(table: Table):
    text = as_latex(table, NASTY)
    columns = len(table.columns)
    lines = [line for line in text.splitlines() if line.endswith(r"\\")]
    assert len(lines) == len(table.rows) + 2
    for line in lines:
        spans = [int(span) for span in re.findall(r"\\multicolumn\{(\d+)\}", line)]
        cells = len(re.findall(r"(?<!\\)&", line)) + 1
        assert cells - len(spans) + sum(spans) == columns
    bare = re.sub(r"\\[{}]", "", text)
    assert bare.count("{") == bare.count("}")
    assert re.findall(r"\\begin\{(\S+?)\}", text) == ["table*", "tabular"]
    assert not re.search(r"(?<!\\)[#$]", re.sub(r"\$(\\gamma|\\delta|-)\$", "", text))


@pytest.mark.skipif(not shutil.which("pdflatex"), reason="there is no TeX here")
@pytest.mark.parametrize("kind", ["[twocolumn]{article}", "[conference]{IEEEtran}"])
def test_tables_compile_inside_a_two_column_paper(tmp_path: Path, kind: str):
    if "IEEEtran" in kind and not _has("IEEEtran.cls"):
        pytest.skip("the class IEEEtran is not installed")
    tables = [HARD, *paper_tables(PLAN, [made(metrics=good(6.0, 0.03))])]
    (tmp_path / "tables.tex").write_text("\n".join(as_latex(t, NASTY) for t in tables), "utf-8")
    (tmp_path / "paper.tex").write_text(
        rf"\documentclass{kind}\usepackage{{booktabs,graphicx}}"
        r"\begin{document}Text.\input{tables}\end{document}"
    )
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-1500:]
    assert "Overfull" not in done.stdout
    assert (tmp_path / "paper.pdf").stat().st_size > 1000


def _has(name: str) -> bool:
    done = subprocess.run(["kpsewhich", name], capture_output=True, check=False)
    return done.returncode == 0
