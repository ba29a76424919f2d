"""Bytes as scripts, so that a page opened from a folder may read them; live/system.js unpacks them."""
import gzip


def zipped(data):
    """gzip as text, fifteen bits per character from U+3400 on, where none means anything to a script; in UTF-16 that is
    a fifteenth more than the bytes. The first character counts the bytes that fill up the last eight."""
    data = gzip.compress(data, 9, mtime=0)
    fill = -len(data) % 15
    whole = data + bytes(fill)
    parts = (int.from_bytes(whole[at:at + 15], "big") for at in range(0, len(whole), 15))
    return chr(0x3400 + fill) + "".join(chr(0x3400 + (part >> shift & 0x7FFF)) for part in parts for shift in range(105, -1, -15))


def script(path, variable, **values):
    """`window.variable`, an object of texts. Its first bytes say that it is UTF-16, whatever a server says."""
    texts = ",".join(f'{key}:"{text}"' for key, text in values.items())
    path.write_text(f"window.{variable}={{{texts}}};", "utf-16", newline="")
