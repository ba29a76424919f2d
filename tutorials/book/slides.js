// The keys of the lecturer: to the next slide, and back.
(() => {
  const slides = [...document.querySelectorAll(".slide")];
  const forward = ["ArrowRight", "ArrowDown", "PageDown", " "];
  const back = ["ArrowLeft", "ArrowUp", "PageUp"];
  addEventListener("keydown", (event) => {
    const step = forward.includes(event.key) - back.includes(event.key);
    if (!step || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const now = Math.round(scrollY / slides[0].getBoundingClientRect().height);
    slides[Math.min(Math.max(now + step, 0), slides.length - 1)].scrollIntoView();
  });
})();
