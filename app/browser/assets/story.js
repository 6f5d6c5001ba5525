// Brings the story of a picked cluster into sight, which may be below the edge of its panel.
window.tofscope ??= {};
window.tofscope.story = {
  show: () => setTimeout(() => {
    document.getElementById("tofscope-story")?.scrollIntoView({block: "nearest"});
  }, 150),  // once it is there
};
