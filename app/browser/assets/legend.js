// Legend over the scene, outside viser's panels, so that it stays visible when these are folded.
window.tofscope ??= {};
{
  const {tofscope} = window;
  const legend = document.getElementById("tofscope-legend") ?? document.createElement("div");
  legend.id = "tofscope-legend";
  document.body.append(legend);

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
