// The search page: the sections that hold all words, best first, each with the place where they stand.
"use strict";
antilock.search = async (list) => {
  const input = document.getElementById("search-words"), said = document.getElementById("search-said");
  const plain = (text) => text.toLowerCase().replace(/[–—−‐]/g, "-");  // of the same length
  said.textContent = "Reading the index.";
  const sections = JSON.parse(new TextDecoder().decode(await antilockSystem.unpacked(ANTILOCK_SECTIONS.packed)))
    .map(([page, title, section, anchor, text]) => ({ page, title, section, anchor, text, words: [title, section, text].map(plain) }));
  /// Words in a heading count more than words of the text, the head of a page more than its parts, a chapter more than a
  /// header of the library.
  const score = ({ page, words: [title, section, text] }, word) =>
    ((section.includes(word) ? 20 : 0) + (title.includes(word) ? (section ? 5 : 30) : 0) + Math.min(5, text.split(word).length - 1)) / (page.startsWith("library") ? 3 : 1);
  /// The text around the first place of the longest word, with every word marked.
  function excerpt(place, { text, words: [, , lower] }, words) {
    const longest = words.reduce((a, b) => (b.length > a.length ? b : a)), at = Math.max(0, lower.indexOf(longest));
    const begin = at < 90 ? 0 : text.indexOf(" ", at - 90) + 1, end = Math.min(text.length, at + 150);
    place.append(begin > 0 ? "… " : "");
    for (let i = begin; i < end;) {
      const next = words.map((word) => [lower.indexOf(word, i), word]).filter(([k]) => k >= 0 && k < end).sort((a, b) => a[0] - b[0])[0];
      place.append(text.slice(i, next ? next[0] : end));
      if (!next) break;
      i = next[0] + next[1].length;
      place.append(Object.assign(document.createElement("mark"), { textContent: text.slice(next[0], i) }));
    }
    place.append(end < text.length ? " …" : "");
  }
  function answer() {
    const words = plain(input.value).split(/\s+/).filter(Boolean);
    list.replaceChildren();
    const found = words.length === 0 ? [] : sections.map((one) => {
      const each = words.map((word) => score(one, word));
      return { one, sum: each.includes(0) ? 0 : each.reduce((a, b) => a + b) };
    }).filter(({ sum }) => sum > 0).sort((a, b) => b.sum - a.sum);
    const most = 50;
    said.textContent = words.length === 0 ? "" : `${found.length} ${found.length === 1 ? "section" : "sections"}${found.length > most ? `, the best ${most} of them` : ""}.`;
    for (const { one } of found.slice(0, most)) {
      const item = document.createElement("li"), link = document.createElement("a"), text = document.createElement("p");
      link.href = `${one.page}.html#${one.anchor}`;
      link.textContent = one.section ? `${one.title} › ${one.section}` : one.title;
      excerpt(text, one, words);
      item.append(link, text);
      list.append(item);
    }
    list.dataset.ready = "";
  }
  input.value = new URLSearchParams(location.search).get("q") ?? "";
  input.addEventListener("input", answer);
  input.form.addEventListener("submit", (event) => event.preventDefault());
  answer();
};
for (const list of document.querySelectorAll("#search-results")) antilock.search(list);
