// Legend over the scene, outside viser's panels, so that it stays visible when these are folded.
window.tofscope ??= {};
{
  const {tofscope} = window;
  const legend = tofscope.overlay("tofscope-legend");

  tofscope.legend = {
    // Writes the legend, HTML of one box, or "" for none.
    show(html) {
      tofscope.legendSize?.disconnect();
      legend.innerHTML = html;
      const box = legend.firstElementChild;
      if (box) tofscope.legendSize = tofscope.watchHeight(box, "--legend-height");
      else document.documentElement.style.setProperty("--legend-height", "0px");
    },
  };
}
