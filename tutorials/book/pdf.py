#!/usr/bin/python3
"""The whole book as one PDF, printed by Chromium from the pages of build/book.

Run: tutorials/book/pdf.py [FILE]    FILE is build/book.pdf if none is named

Needs tutorials/book/build and `.ci/install browser`. The chapters stand in the order of
course.toml, and the guides follow. The pages of the library are left out, and so are links to them.
"""
import base64
import re
import sys
import tempfile
from pathlib import Path

import slides
from course import read as read_course
from pages import EXTRA, TEACHING

ROOT = Path(__file__).resolve().parents[2]
BOOK = ROOT / "build/book"
HEAD = re.compile(r'<link [^>]*rel="?stylesheet[^>]*>')
ARTICLE = re.compile(r"<article[^>]*>(.*)</article>", re.S)

# Ids and links of the pages become those of one page: `#eq-23` of 01_domain becomes
# `#01_domain--eq-23`.
JOIN = """
  const dropped = document.querySelectorAll("#run, section.printed:not(:last-child) .foot");
  dropped.forEach((part) => part.remove());
  const pages = new Set([...document.querySelectorAll("section.printed")].map((page) => page.id));
  for (const page of document.querySelectorAll("section.printed")) {
    for (const part of page.querySelectorAll("[id]")) part.id = `${page.id}--${part.id}`;
    for (const link of page.querySelectorAll("a[href]")) {
      const parts = /^(?:([\\w.]+)\\.html)?(?:#(.*))?$/.exec(link.getAttribute("href"));
      const [, name, anchor] = parts ?? [];
      if (name === undefined && anchor === undefined) {
        if (!link.href.startsWith("http")) link.removeAttribute("href");
        continue;
      }
      const to = name ?? page.id;
      if (pages.has(to)) link.setAttribute("href", anchor ? `#${to}--${anchor}` : `#${to}`);
      else link.removeAttribute("href");
    }
  }
  for (const part of document.querySelectorAll("details")) part.open = true;
  for (const image of document.querySelectorAll("img")) image.loading = "eager";"""
LOADED = """
  const done = arguments[arguments.length - 1];
  Promise.all([...document.images].map((image) => image.decode().then(() => "", () => image.src)))
    .then((all) => document.fonts.ready.then(() => done(all.filter(Boolean))));"""
FOOTER = ('<div style="width: 100%; text-align: center; font: 8px sans-serif">'
          '<span class="pageNumber"></span></div>')


def fail(what):
    sys.exit(f"tutorials/book/pdf.py: {what}")


def names():
    """The pages of the book in their order."""
    chapters = [name for part in read_course() for name in part.pages]
    # slides are printed alone
    guides = [name for name in TEACHING + EXTRA if name not in slides.NAMES]
    return ["index", *chapters, *guides]


def whole(book, pages):
    """One page of HTML with the articles of these pages. It may lie in any folder."""
    first = (book / "index.html").read_text()
    out = ["<!doctype html><html lang=en><head><meta charset=utf-8><title>Antilock</title>",
           *HEAD.findall(first), '</head><body data-theme="light"><div class="content">']
    for name in pages:
        article = ARTICLE.search((book / f"{name}.html").read_text())
        if article is None:
            fail(f"{book / name}.html has no article")
        text = re.sub(r"(?s)<script.*?</script>", "", article[1])
        out.append(f'<section class="printed" id="{name}">{text}</section>')
    text = "\n".join([*out, "</div></body></html>"])
    return re.sub(r'"(?=_(?:images|static)/)', f'"{book.as_uri()}/', text)


def printed(browser):
    """The bytes of the PDF of the open page."""
    options = {"preferCSSPageSize": True, "printBackground": True, "displayHeaderFooter": True,
               "headerTemplate": "<span></span>", "footerTemplate": FOOTER,
               "generateDocumentOutline": True, "transferMode": "ReturnAsStream"}
    stream, parts = browser.execute_cdp_cmd("Page.printToPDF", options)["stream"], []
    while True:
        part = browser.execute_cdp_cmd("IO.read", {"handle": stream, "size": 1 << 20})
        data = part["data"]
        parts.append(base64.b64decode(data) if part["base64Encoded"] else data.encode())
        if part["eof"]:
            return b"".join(parts)


def main(arguments):
    if len(arguments) > 1 or any(argument.startswith("-") for argument in arguments):
        fail("accepted: at most one file name")
    target = Path(arguments[0] if arguments else ROOT / "build/book.pdf")
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
    except ImportError:
        fail("python3-selenium is missing; .ci/install browser installs it")
    pages = names()
    missing = [name for name in pages if not (BOOK / f"{name}.html").exists()]
    if missing:
        fail(f"{BOOK / missing[0]}.html is missing; tutorials/book/build makes it")
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for argument in ("--headless=new", "--no-sandbox"):
        options.add_argument(argument)
    browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    try:
        browser.set_script_timeout(600)
        browser.set_page_load_timeout(600)
        with tempfile.NamedTemporaryFile("w", suffix=".html") as page:
            page.write(whole(BOOK, pages))
            page.flush()
            browser.get(Path(page.name).as_uri())
            browser.execute_script(JOIN)
            broken = browser.execute_async_script(LOADED)
            if broken:
                fail(f"{broken[0]} is no picture")
            pdf = printed(browser)
    finally:
        browser.quit()
    target.write_bytes(pdf)
    pages_of_paper = pdf.count(b"/Type /Page") - pdf.count(b"/Type /Pages")
    print(f"{target}: {len(pdf) / 1e6:.1f} MB, {pages_of_paper} pages")


if __name__ == "__main__":
    main(sys.argv[1:])
