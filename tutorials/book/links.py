"""Prose with its links turned to the pages of the book."""
import re

from katex import TAG, anchor

CODE = r"`[^`]*`|\$\$[^$]*\$\$|\$[^$]*\$"
TOKEN = (rf"(?P<code>{CODE})", rf"(?P<image>!?)\[(?P<words>(?:{CODE}|[^\]`$])+)\]\((?P<to>[^)\s]+)\)",
         r"\b(?P<kind>[Cc]hapters?|[Tt]utorials?) (?P<numbers>\d\d(?:(?:, | and | to )\d\d)*)\b(?![\]\w])", r"(?<![\w)])\((?P<tag>\d\d?)\)(?!\w)")
FORMULA = re.compile(r"[ε∂∫Γ-ωΓΣΩ≤≥]|[_^]\{")


def term_anchor(term):
    return "term_" + re.sub(r"\W+", "-", term.lower())


def linked(lines, page, chapter, equations, complain, spell=lambda text: text, terms=()):
    """Links lead to `page(target)`, or nowhere where that is None; `chapter 07` to the page `chapter(number)`; `(23)` to the
    equation, of this page or of that which `equations` names; the first of each of `terms` to its line of the glossary. Code and
    formulas stay as they are, and `spell` is for what is none of these. `complain` is told of a formula that stands as code."""
    names = "|".join(sorted(map(re.escape, terms), key=len, reverse=True)) or "(?!)"
    token = re.compile("|".join((*TOKEN, rf"(?<![\w-])(?P<term>(?i:{names}))(?:e?s)?(?![\w-])")))
    own, met, out, fenced = set(TAG.findall("\n".join(lines))), set(), [], False

    def plain(text):
        return spell(text).replace("[](", "\\[\\](")  # a lambda, not a link

    def number(found):
        to = chapter(found[0])
        return f"[{found[0]}]({to}.md)" if to else found[0]

    def one(found, bare):
        if found["code"]:
            if found[0].startswith("`") and FORMULA.search(found[0]):
                complain(f"{found[0]}: a formula stands between dollars")
            return found[0]
        if found["to"]:
            to, words = page(found["to"]), "".join(part if i % 2 else plain(part) for i, part in enumerate(re.split(f"({CODE})", found["words"])))
            if to is None and not found["image"]:
                return f"`{found['to'].lstrip('./')}`"
            return f"{found['image']}[{words}]({to})" if to else words  # a picture that the book has not: its sentence
        if found["kind"]:
            return found["kind"] + " " + re.sub(r"\d\d", number, found["numbers"])
        if found["tag"] and not bare:
            to = "" if found["tag"] in own else equations.get(found["tag"])
            return found[0] if to is None else f'<a href="{to and to + ".html"}#{anchor(found["tag"])}">{found[0]}</a>'
        if found["term"] and not bare and found["term"].lower() not in met and not found.string.startswith("|"):
            met.add(found["term"].lower())
            return f'<a class="term" href="glossary.html#{term_anchor(found["term"])}">{found[0]}</a>'
        return plain(found[0])

    for line in lines:
        fenced ^= line.startswith("```")
        if fenced or line.startswith(("    ", "<", "```")):
            out.append(line)
            continue
        text, at, bare = "", 0, line.startswith(("#", ":"))  # a heading has no link of ours in it
        for found in token.finditer(line):
            text += plain(line[at:found.start()]) + one(found, bare)
            at = found.end()
        out.append(text + plain(line[at:]))
    return out
