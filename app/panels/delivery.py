"""Delivery of messages and of background tasks' progress to the browser."""

import shlex
from collections.abc import Sequence

import viser

from app.browser.assets import call
from app.browser.plots import enlarge_plots
from app.browser.script import copy_link
from app.output.text import escaped
from app.session.outbox import (
    Download,
    EnlargePlots,
    LinkToCopy,
    Message,
    Notice,
    OpeningFailed,
)
from app.session.tasks import TaskState


class Delivery:
    """Sends notifications, downloads and links to the browser.

    Args:
        client: that receives them.
    """

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self._last: dict[str, viser.NotificationHandle] = {}
        self._tasks: dict[str, viser.NotificationHandle] = {}

    def deliver(self, messages: Sequence[Message]) -> None:
        """Send messages to the browser, in order."""
        for message in messages:
            match message:
                case Notice():
                    self._notify(message)
                case OpeningFailed():
                    self._tell_failure(message)
                case Download(name, content):
                    self._client.send_file_download(name, content, save_immediately=True)
                case LinkToCopy(token):
                    copy_link(self._client, token)
                case EnlargePlots():
                    enlarge_plots(self._client)

    def show_tasks(self, tasks: Sequence[TaskState]) -> None:
        """Show these tasks as running, and close notifications of ended ones."""
        for title in self._tasks.keys() - {task.title for task in tasks}:
            self._tasks.pop(title).remove()
        for task in tasks:
            if (loading := self._tasks.get(task.title)) is None:
                self._tasks[task.title] = self._client.add_notification(
                    task.title, task.text, loading=True, with_close_button=False
                )
            elif loading.body != task.text:
                loading.body = task.text

    def _tell_failure(self, failed: OpeningFailed) -> None:
        kept = "No recording is open." if failed.kept is None else f"{failed.kept} stays open."
        holds = f"What the file holds: tofscope info {shlex.quote(str(failed.path))}"
        title = f"{failed.label} cannot be opened"
        said = (title, failed.reason, f"{kept}\n{holds}")
        call(self._client, "failure.show", *map(escaped, said))

    def _notify(self, notice: Notice) -> None:
        if notice.replaces and (before := self._last.pop(notice.title, None)) is not None:
            before.remove()
        handle = self._client.add_notification(
            notice.title,
            escaped(notice.sentence),  # it may name a file
            color=notice.colour,
            auto_close_seconds=notice.seconds,
        )
        if notice.replaces:
            self._last[notice.title] = handle
