from html.parser import HTMLParser

from app.study import page
from app.study.table import Column, Table

NASTY = '<script>alert("x")</script> & more'


class _Structure(HTMLParser):
    """Collects texts, and sees that every tag is closed in its turn."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[str] = []
        self.texts: list[str] = []

    def handle_starttag(self, tag, attrs):
        self.seen.append(tag)
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.texts.append(data)


def test_a_page_is_well_formed_and_shows_whatever_names_hold():
    table = Table(
        "t",
        NASTY,
        NASTY,
        (Column("name", NASTY), Column("a", "a", ".1f", NASTY, from_paper=True)),
        ({"name": NASTY, "a": 1.0}, {"name": "b", "a": None}),
    )
    blocks = [
        page.paragraph(NASTY),
        page.items([NASTY]),
        page.terms({NASTY: NASTY}),
        page.command(NASTY),
        page.picture(b"png", NASTY),
        page.links([NASTY]),
        page.folded(NASTY, page.table(table)),
    ]
    parser = _Structure()
    parser.feed(page.page(NASTY, [page.Section(NASTY, blocks)]))
    assert parser.open == []
    assert "script" not in parser.seen
    assert parser.texts.count(NASTY) >= 12
    assert parser.texts.count("1.0") == 1


def test_a_page_loads_nothing_from_elsewhere():
    text = page.page("title", [page.Section("a", [page.picture(b"png", "a picture")])])
    assert "http" not in text
    assert 'src="data:image/png;base64,' in text
