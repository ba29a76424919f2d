// On paper nothing is folded away.
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((part) => { part.open = true; }));
// What is wider than the page scrolls in itself, also by the keyboard.
for (const part of document.querySelectorAll(".highlight pre, .table-wrapper")) part.tabIndex = 0;
