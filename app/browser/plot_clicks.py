"""Line at the current time in viser's plots, and clicks in plots that seek.

The line is a style sheet, so that a new frame sends about a hundred bytes and redraws no plot.
A click is entered into a number field by the script of `app.browser.fields`.
"""

import viser

from app.browser.internals import PLOT_AREA, PLOT_CANVAS, run_script

_MARK = "tofscope-plots"  # class of the element whose later siblings are the plots
_PLOT = f":has(> .{_MARK}) ~ * {PLOT_AREA}"
_PALE = f":has(> .{_MARK}) ~ * {PLOT_CANVAS}"

_SCRIPT = """
window.tofscopePlots = {field: '%(field)s', start: %(start)r, end: %(end)r};
if (!window.tofscopePlotsListen) {
  window.tofscopePlotsListen = true;
  document.addEventListener('click', event => {
    const plot = event.target.closest('%(area)s');
    if (!plot || !plot.matches('%(plot)s')) return;
    const {field, start, end} = window.tofscopePlots;
    const time = window.tofscopeAlong(event, plot, start, end);
    window.tofscopeSet(field, time.toFixed(3));
  });
}
"""


def seek_by_clicks(client: viser.ClientHandle, field: str, start: float, end: float) -> None:
    """Let clicks in the plots set a number field.

    Args:
        client: owner of the page.
        field: the field's id in the page.
        start: value at the left edge of the plots.
        end: value at their right edge.
    """
    names = {"area": PLOT_AREA, "plot": _PLOT}
    run_script(client, _SCRIPT % {"field": field, "start": start, "end": end, **names})


def cursor(share: float, *, pale: bool) -> str:
    """HTML that draws a line in the plots that follow it.

    Args:
        share: position of the line, 0 at the plots' left edge, 1 at the right.
        pale: whether the plots are drawn pale, as outdated.
    """
    faded = f"{_PALE} {{opacity: 0.25}}" if pale else ""
    return (
        f'<span class="{_MARK}"></span><style>{_PLOT} {{cursor: pointer}} {_PLOT}::after {{'
        f"content: ''; position: absolute; top: 0; bottom: 0; left: {100 * share:.3f}%; "
        "border-left: 1.5px solid currentColor; opacity: 0.6; pointer-events: none} "
        f"{faded}</style>"
    )
