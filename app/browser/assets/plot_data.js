// Numbers of every frame of a recording, of side A and side B, as they arrive.
window.tofscope ??= {};
{
  const NONE = new Float32Array(0);
  let times = new Float64Array([0]), sides = {};

  const side = name => sides[name] ??= {values: {}, counts: null, stale: false};
  const decoded = text => window.tofscope.bytes(text).buffer;

  window.tofscope.plotData = {
    // Begins with a recording, given its times (K,) s.
    begin: text => {
      times = new Float64Array(decoded(text));
      sides = {};
    },
    // The numbers of a side go on being drawn, pale, until new ones come.
    outdate: of => { side(of).stale = true; },
    // Takes numbers of some frames: `counts` says whether their pairs count in the means.
    add: (of, frames, counts, arrays) => {
      if (side(of).stale) delete sides[of];
      const into = side(of), at = new Uint32Array(decoded(frames));
      const flags = new Uint8Array(decoded(counts));
      into.counts ??= new Uint8Array(times.length).fill(1);
      at.forEach((frame, k) => { into.counts[frame] = flags[k]; });
      for (const [name, text] of Object.entries(arrays)) {
        const array = into.values[name] ??= new Float32Array(times.length).fill(NaN);
        const numbers = new Float32Array(decoded(text));
        at.forEach((frame, k) => { array[frame] = numbers[k]; });
      }
    },
    get times() { return times; },
    get seconds() { return Math.max(times[times.length - 1], 1e-3); },
    // A quantity of a side (K,), empty while there is none of it.
    values: (name, of) => name === "time" ? times : side(of).values[name] ?? NONE,
    counts: of => side(of).counts,
    alpha: of => side(of).stale ? 0.25 : 1,
    // A value as its quantity is written.
    written: (value, {digits, signed}) => {
      if (value === undefined || Number.isNaN(value)) return "–";
      return ((signed && value >= 0 ? "+" : "") + value.toFixed(digits)).replace("-", "−");
    },
    indexOf: time => window.tofscope.indexOf(times, time),
    nearest: time => window.tofscope.nearest(times, time),
  };
}
