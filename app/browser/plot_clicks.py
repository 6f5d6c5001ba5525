"""Line at the current time in plots of viser, and clicks in them that go to a time.

The line is a style sheet, so that a new frame costs a hundred bytes and no plot is drawn again.
A click is written into a number field, by what `app.browser.fields` has set up.
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
    """Make clicks in the plots set a number field from now on.

    Args:
        client: whose page.
        field: the field's id in the page.
        start: value at the left edge of the plots.
        end: value at their right edge.
    """
    names = {"area": PLOT_AREA, "plot": _PLOT}
    run_script(client, _SCRIPT % {"field": field, "start": start, "end": end, **names})


def cursor(share: float, *, pale: bool) -> str:
    """HTML that draws a line in the plots after it.

    Args:
        share: of the plots' width, from the left, at which the line is.
        pale: whether the plots are drawn pale, since what they show does not hold any more.
    """
    faded = f"{_PALE} {{opacity: 0.25}}" if pale else ""
    return (
        f'<span class="{_MARK}"></span><style>{_PLOT} {{cursor: pointer}} {_PLOT}::after {{'
        f"content: ''; position: absolute; top: 0; bottom: 0; left: {100 * share:.3f}%; "
        "border-left: 1.5px solid currentColor; opacity: 0.6; pointer-events: none} "
        f"{faded}</style>"
    )
