"""Makes DejaVuSans-subset.ttf from DejaVuSans.ttf (needs fonttools): subset_font.py SOURCE TARGET LICENCE_TEXT

Besides leaving out glyphs, it adapts the font to how plotters 0.3.7 sets text with `ab_glyph`, so that PNG and SVG agree:
- a font size there is the line height, and the SVG writes em = size / 1.24: the line height becomes 1.24 em;
- the pen is put at the left edge of the ink, not at the origin: every glyph gets an invisible point at its origin;
- the baseline comes 0.14 em higher than in the SVG: all outlines are lowered by that.
"""

import sys

from fontTools import subset
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.pens.transformPen import TransformPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont

LINE_HEIGHT = 1.24
LOWERED_BY = 0.14
ASCENT_SHARE = 0.8
LICENCE = 13
CHARACTERS = [
    (0x20, 0x7E),
    (0xA0, 0xFF),
    (0x370, 0x3FF),
    (0x2010, 0x2026),
    (0x2032, 0x2033),
    (0x2070, 0x209C),
    (0x2190, 0x2199),
    (0x21D0, 0x21D4),
    (0x2200, 0x222B),
    (0x2248, 0x2248),
    (0x2260, 0x2261),
    (0x2264, 0x2265),
    (0x226A, 0x226B),
    (0x22A5, 0x22A5),
    (0x22C5, 0x22C5),
]


def subset_of(source):
    options = subset.Options(hinting=False, layout_features=[], notdef_outline=True)
    options.name_IDs = [0, 1, 2, 3, 4, 5, 6, LICENCE]
    options.drop_tables += ["FFTM", "GDEF", "GPOS", "GSUB", "MATH", "gasp"]
    font = subset.load_font(source, options)
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=[c for first, last in CHARACTERS for c in range(first, last + 1)])
    subsetter.subset(font)
    return font


def adapted_glyph(glyphs, name, shift):
    outline = DecomposingRecordingPen(glyphs)
    glyphs[name].draw(outline)
    if not outline.value:
        return None
    pen = TTGlyphPen(None)
    outline.replay(TransformPen(pen, (1, 0, 0, 1, 0, shift)))
    pen.moveTo((0, 0))
    pen.lineTo((1, 0))
    pen.closePath()
    return pen.glyph(dropImpliedOnCurves=False)


def adapt_to_plotters(font):
    em = font["head"].unitsPerEm
    glyphs = font.getGlyphSet()
    adapted = {name: adapted_glyph(glyphs, name, -round(LOWERED_BY * em)) for name in font.getGlyphOrder()}
    for name, glyph in adapted.items():
        if glyph is not None:
            font["glyf"][name] = glyph
            glyph.recalcBounds(font["glyf"])
            font["hmtx"][name] = (font["hmtx"][name][0], glyph.xMin)
    line = round(LINE_HEIGHT * em)
    font["hhea"].ascent = round(ASCENT_SHARE * line)
    font["hhea"].descent = font["hhea"].ascent - line
    font["hhea"].lineGap = 0
    for record in font["name"].names:
        if record.nameID in (1, 3, 4, 6):
            separator = "" if record.nameID == 6 else " "
            record.string = f"{record.toUnicode()}{separator}Subset"


if __name__ == "__main__":
    font = subset_of(sys.argv[1])
    adapt_to_plotters(font)
    font.save(sys.argv[2])
    with open(sys.argv[3], "w", encoding="utf-8") as licence:
        licence.write(font["name"].getDebugName(LICENCE).replace("\r\n", "\n").strip() + "\n")
