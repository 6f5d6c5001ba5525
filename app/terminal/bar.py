"""Progress bar at a terminal."""

from typing import TYPE_CHECKING

from robot_assets.printable import printable

if TYPE_CHECKING:
    from rich.console import Console


class Bar:
    """One-line progress bar with count, name and remark; it disappears when hidden.

    Args:
        console: a terminal.
        total: of the count.
    """

    def __init__(self, console: "Console", total: int) -> None:
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
        from rich.table import Column

        self._console = console
        self._progress = Progress(
            MofNCompleteColumn(),
            BarColumn(bar_width=None, table_column=Column(ratio=1)),
            TextColumn(
                "{task.description}",
                markup=False,
                table_column=Column(ratio=2, no_wrap=True, overflow="ellipsis"),
            ),
            TextColumn("{task.fields[remark]}", markup=False, table_column=Column(no_wrap=True)),
            console=console,
            auto_refresh=False,  # workers are forked, which is unsafe with a refresh thread
            transient=True,
            redirect_stdout=False,
            redirect_stderr=False,
            expand=True,
        )
        self._task = self._progress.add_task("", total=total, remark="")

    def show(self, finished: int, name: str, remark: str = "") -> None:
        """Redraw the line."""
        self._progress.update(
            self._task, completed=finished, description=printable(name), remark=remark
        )
        self._progress.start()
        self._progress.refresh()
        self._console.show_cursor(True)  # it would stay hidden if the process were killed

    def hide(self) -> None:
        """Clear the line, so that something can be printed."""
        self._progress.stop()
