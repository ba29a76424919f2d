// A live figure that the reader has not come near has not drawn anything yet. On paper its still
// takes its place.
for (const box of document.querySelectorAll(".live")) {
  const still = box.querySelector("img")?.cloneNode();
  if (!still) continue;
  still.className = "live-paper";
  box.after(still);
}
// On paper nothing is folded away.
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((part) => { part.open = true; }));
// What is wider than the page scrolls in itself, also by the keyboard.
for (const part of document.querySelectorAll(".highlight pre, .table-wrapper")) part.tabIndex = 0;
// The reader's predictions are kept by page and question, and shown again where the page answers
// them. A browser that keeps nothing (a private window, a setting) throws; then the text lasts as
// long as the page.
for (const box of document.querySelectorAll(".predictions")) {
  const inputs = [...box.querySelectorAll("input")], forget = box.querySelector("button");
  const shown = document.querySelector(".predicted");
  const key = (input) => `antilock-prediction/${box.dataset.page}/${input.dataset.question}`;
  const stored = (action) => {
    try { return action(localStorage); } catch { return null; }
  };
  const part = (name, text) => Object.assign(document.createElement(name), { textContent: text });
  const typed = (input) => input.value.trim();

  function show() {
    const given = inputs.filter(typed);
    for (const input of inputs) {
      input.closest("p").querySelector(".typed").textContent = typed(input);
    }
    forget.disabled = !given.length;
    shown.hidden = !given.length;
    shown.replaceChildren(part("b", "You predicted: "));
    for (const input of given) {
      const letter = input.dataset.question;
      shown.append(part("span", letter ? `(${letter}) ` : ""), part("q", typed(input)), " ");
    }
  }
  for (const input of inputs) {
    input.value = stored((store) => store.getItem(key(input))) ?? "";
    input.addEventListener("input", () => {
      if (typed(input)) stored((store) => store.setItem(key(input), input.value));
      else stored((store) => store.removeItem(key(input)));
      show();
    });
  }
  forget.addEventListener("click", () => {
    for (const input of inputs) {
      input.value = "";
      stored((store) => store.removeItem(key(input)));
    }
    show();
    inputs[0].focus();  // a disabled button loses the focus of the keyboard
  });
  show();
  box.hidden = false;
}
// An equation or a term that a link names shows itself beside it: for a pointer that hovers, and for the keyboard.
(() => {
  const folder = document.currentScript.src.replace(/[^/]*$/, ""), page = location.pathname.split("/").pop() || "index.html";
  const hint = Object.assign(document.createElement("div"), { id: "hint", hidden: true });
  hint.setAttribute("role", "tooltip");
  let hints, over = null;
  const known = () => (hints ??= new Promise((done) => {
    const script = Object.assign(document.createElement("script"), { src: `${folder}hints.js`, onload: () => done(window.ANTILOCK_HINTS), onerror: () => done({}) });
    document.head.append(script);
  }));
  function hide() {
    over?.removeAttribute("aria-describedby");
    over = null;
    hint.hidden = true;
  }
  async function show(link) {
    hide();
    over = link;
    const target = link.getAttribute("href"), own = target.startsWith("#") && document.getElementById(target.slice(1));
    const text = own ? own.innerHTML : (await known())[target.startsWith("#") ? page + target : target];
    if (!text || over !== link) return;
    hint.innerHTML = text;
    hint.querySelectorAll("[id]").forEach((part) => part.removeAttribute("id"));
    document.querySelector("article").append(hint);
    link.setAttribute("aria-describedby", "hint");
    hint.hidden = false;
    const at = link.getBoundingClientRect(), box = hint.getBoundingClientRect(), width = document.documentElement.clientWidth;
    const below = at.bottom + box.height + 12 < innerHeight;
    hint.style.left = `${Math.max(8, Math.min(at.left, width - box.width - 8)) + scrollX}px`;
    hint.style.top = `${(below ? at.bottom + 6 : at.top - box.height - 6) + scrollY}px`;
  }
  for (const link of document.querySelectorAll('article a[href*="#eq-"], article a[href*="#term_"]')) {
    link.addEventListener("pointerenter", (event) => event.pointerType === "mouse" && show(link));
    link.addEventListener("pointerleave", hide);
    link.addEventListener("focus", () => link.matches(":focus-visible") && show(link));
    link.addEventListener("blur", hide);
  }
  addEventListener("keydown", (event) => event.key === "Escape" && hide());
})();
