"""Float pictures as lists of values, rows from the top, and the difference of two pictures."""
import array
import sys


def _ppm_words(data):
    """The four words of a PPM's header, without comments, and the offset of its pixels."""
    words, i = [], 0
    while len(words) < 4:
        while data[i:i + 1].isspace():
            i += 1
        if data[i:i + 1] == b"#":
            i = data.index(b"\n", i)
            continue
        end = i
        while not data[end:end + 1].isspace():
            end += 1
        words.append(data[i:end])
        i = end
    return words, i + 1


def read_ppm(file):
    """A binary PPM of 16 bits, as values from 0 to 1."""
    data = file.read_bytes()
    words, begin = _ppm_words(data)
    width, height, most = (int(word) for word in words[1:])
    if words[0] != b"P6" or most != 65535:
        raise ValueError(f"{file}: not a PPM of 16 bits")
    values = array.array("H", data[begin:begin + 6 * width * height])
    if sys.byteorder == "little":
        values.byteswap()
    return width, height, [value / most for value in values]


def read_pfm(file):
    """A colour PFM of this machine's byte order."""
    _, size, scale, pixels = file.read_bytes().split(b"\n", 3)
    width, height = (int(word) for word in size.split())
    if (float(scale) < 0) != (sys.byteorder == "little"):
        raise ValueError(f"{file}: not in this machine's byte order")
    values = array.array("f", pixels)
    # Its rows are stored from the bottom.
    top_down = array.array("f")
    for y in reversed(range(height)):
        top_down.extend(values[3 * width * y:3 * width * (y + 1)])
    return width, height, top_down


def difference(ours, theirs):
    """RMS error, and share of values off by more than 2/255; our values are clamped like theirs."""
    if ours[:2] != theirs[:2]:
        raise ValueError("the pictures are of different sizes")
    squares, off = 0.0, 0
    for x, y in zip(ours[2], theirs[2]):
        apart = abs(min(max(x, 0.0), 1.0) - y)
        squares += apart * apart
        off += apart > 2 / 255
    count = len(ours[2])
    return {"rmse": (squares / count) ** 0.5, "share_off": off / count}
