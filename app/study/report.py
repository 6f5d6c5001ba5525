"""Report of a study: a folder with page, tables and figure."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.errors import InputError
from app.output import checks
from app.output.checks import is_ours
from app.output.text import utf8
from app.output.writing import write
from app.study import page
from app.study.ablation_findings import ablation_findings
from app.study.conditions import (
    conditions,
    opening_text,
    parameters_text,
    simulate_command,
    simulator_texts,
    study_command,
)
from app.study.figure import sweep_figure
from app.study.findings import findings
from app.study.further_tables import (
    ablation_table,
    metrics_table,
    recordings_table,
    scenarios_table,
    sweep_table,
)
from app.study.latex import LONGEST, as_latex
from app.study.paper import paper_numbers
from app.study.paper_tables import paper_tables
from app.study.plan import Plan
from app.study.progress import duration
from app.study.rows import Row, rows_of
from app.study.software import software_digest, versions
from app.study.table import Table
from app.study.text_files import as_csv, as_markdown
from app.study.work import Outcome
from estimator import to_nested

PAGE = "index.html"
_TABLES = "tables"
_NAMES = ("table_1", "table_2", "scenarios", "metrics", "sweep", "ablation", "recordings")
_KNOWN = {f"{_TABLES}/{name}.{ending}" for name in _NAMES for ending in ("csv", "md", "tex")} | {
    "sweep.png",
    "sweep.pdf",
}
"""Every file that a report may contain beside the page."""


@dataclass(frozen=True)
class Study:
    """A finished study.

    Attributes:
        plan: of the study.
        outcomes: of all evaluated recordings, in the plan's order.
        failures: a sentence per recording that failed.
        command: as typed.
        seconds: wall-clock time of this run.
    """

    plan: Plan
    outcomes: Sequence[Outcome]
    failures: Sequence[str]
    command: str
    seconds: float

    def rows(self) -> list[Row]:
        """Results of the tables and of the sweep."""
        sources = set(self.plan.sources())
        return rows_of(outcome for outcome in self.outcomes if outcome.source in sources)

    def ablation_rows(self) -> list[Row]:
        """Results of the ablation."""
        sources = set(self.plan.ablation_sources())
        rows = rows_of(outcome for outcome in self.outcomes if outcome.source in sources)
        return [row for row in rows if row.parameters.n == self.plan.parameters.n]

    def tables(self) -> list[Table]:
        """All tables, the paper's first."""
        plan, rows = self.plan, self.rows()
        tables = [
            *(table for table in paper_tables(plan, rows) if _any(table)),
            scenarios_table(plan, rows),
            metrics_table(plan, rows),
            sweep_table(plan, rows),
            ablation_table(plan, self.ablation_rows()),
            recordings_table(plan, rows),
        ]
        return [table for table in tables if table and table.rows]


def _any(table: Table) -> bool:
    """Whether any cell of the table has recordings."""
    return any(row["trials"] for row in table.rows)


def write_report(study: Study, folder: Path) -> list[Table]:
    """Write page, tables and figure, and return the tables.

    Raises:
        InputError: a file cannot be written.
    """
    tables, figure = study.tables(), sweep_figure(study.plan, study.rows())
    caption = conditions(study.plan)
    files: dict[str, bytes] = {}
    for table in tables:
        files |= {
            f"{_TABLES}/{table.name}.csv": utf8(as_csv(table)),
            f"{_TABLES}/{table.name}.md": utf8(as_markdown(table, caption)),
        }
        if len(table.rows) <= LONGEST:
            files[f"{_TABLES}/{table.name}.tex"] = utf8(as_latex(table, caption))
    content = json.dumps(_as_json(study, tables), indent=1)
    files[f"{_TABLES}/tables.json"] = f"{content}\n".encode()
    files |= {f"sweep.{ending}": content for ending, content in (figure or {}).items()}
    files[PAGE] = utf8(_page(study, tables, figure))
    try:
        (folder / _TABLES).mkdir(parents=True, exist_ok=True)
        # Files of an earlier study in this folder do not belong to this page.
        for name in _KNOWN - files.keys():
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise InputError(f"{error.filename} cannot be written: {error.strerror}.") from error
    for name, content in files.items():
        write(folder / name, content)
    return tables


def check_folder(folder: Path) -> None:
    """Check that a report overwrites nothing in a folder but another report.

    Raises:
        InputError: it would.
    """
    page = folder / PAGE
    if is_ours(page, checks.PAGE):
        return
    theirs = next((folder / n for n in (PAGE, *sorted(_KNOWN)) if (folder / n).exists()), None)
    if theirs:
        raise InputError(
            f"{theirs} exists and is not of a study; remove it or give another folder as --out."
        )


def _as_json(study: Study, tables: Sequence[Table]) -> dict[str, Any]:
    """Tables with everything that determines them, equal in every run of the same study."""
    plan = study.plan
    return {
        "simulated": plan.recordings is None,
        "methods": plan.methods,
        "parameters": {k: v for k, v in to_nested(plan.parameters).items() if k != "method"},
        "seed": plan.seed if plan.recordings is None else None,
        "noise": plan.noise if plan.recordings is None else None,
        "imperfections": plan.imperfections if plan.recordings is None else None,
        "rig": plan.rig.name if plan.rig else None,
        "versions": versions(),
        "software": software_digest(plan.method_files),
        "paper": paper_numbers().source,
        "tables": {table.name: table.rows for table in tables},
        "not_evaluated": list(study.failures),
    }


def _page(study: Study, tables: Sequence[Table], figure: dict[str, bytes] | None) -> str:
    plan = study.plan
    sections = [_first(study)]
    found = findings(plan, study.rows())
    sections.append(page.Section("What the numbers say beside the paper's", [page.items(found)]))
    for table in tables:
        shown = page.table(table)
        if table.name == "recordings" and plan.recordings is None:
            shown = page.folded(f"{len(table.rows)} lines", shown)
        endings = ("csv", "md", "tex") if len(table.rows) <= LONGEST else ("csv", "md")
        blocks = [shown, page.links([f"{_TABLES}/{table.name}.{e}" for e in endings])]
        if table.name == "ablation":
            blocks.insert(0, page.items(ablation_findings(plan, table)))
        if table.name == "sweep" and figure:
            picture = page.picture(figure["png"], "Error over n, a line for each speed")
            blocks = [picture, page.links(["sweep.png", "sweep.pdf"]), *blocks]
        sections.append(page.Section(table.title, blocks))
    sections.append(_last(study))
    return page.page("The scene-flow study", sections)


def _first(study: Study) -> page.Section:
    plan = study.plan
    blocks: list[str] = []
    if plan.recordings is None:
        rig = f"the rig {plan.rig.name}" if plan.rig else "a rig whose dimensions are ours"
        blocks.append(
            page.paragraph(
                "Everything here is simulated: the paper's recordings are not public. These are "
                f"{len(plan.sources())} recordings made by ray casting, as its experiments are "
                f"described, with {rig}; the paper's own numbers stand beside.",
                "simulated",
            )
        )
        blocks.append(page.items(simulator_texts(plan)))
    else:
        text = f"{len(plan.sources())} recordings that were given. {opening_text(plan)}"
        blocks.append(page.paragraph(text.strip()))
    if study.failures:
        blocks.append(page.paragraph("Not evaluated:"))
        blocks.append(page.items(list(study.failures)))
    warnings = [f"{o.source.name}: {w}" for o in study.outcomes for w in o.warnings]
    if warnings:
        blocks.append(page.folded(f"{len(warnings)} warnings", page.items(warnings)))
    return page.Section("What this is", blocks)


def _last(study: Study) -> page.Section:
    plan = study.plan
    making = sum(o.seconds for o in study.outcomes)
    estimating = sum(r.seconds for o in study.outcomes for r in o.results)
    frames = sum(o.frames for o in study.outcomes)
    pairs = sum(int((r.metrics or {}).get("pairs") or 0) for o in study.outcomes for r in o.results)
    blocks = [
        page.command(study.command),
        page.terms(
            {
                "Methods": ", ".join(plan.methods),
                "Parameters": parameters_text(plan),
                "Work": f"{len(study.outcomes)} recordings of {frames} frames in all; {pairs} "
                "estimates of pairs that count.",
                "Duration": f"{duration(making)} of one core to "
                f"{'simulate' if plan.recordings is None else 'open'} and "
                f"{duration(estimating)} to estimate; this run took {duration(study.seconds)} on "
                "the clock, results that were there before left out.",
                "Versions": ", ".join(f"{name} {number}" for name, number in versions().items()),
                "Software": f"digest {software_digest(plan.method_files)[:16]}",
                "Paper": paper_numbers().source,
            }
        ),
    ]
    if plan.recordings is None:
        blocks.append(page.paragraph("The recordings, as files, are made by"))
        blocks.append(page.command(simulate_command(plan)))
        blocks.append(page.paragraph("and evaluated by"))
        blocks.append(page.command(study_command(plan)))
    blocks.append(page.links([f"{_TABLES}/tables.json"]))
    return page.Section("How to make it again", blocks)
