"""Small robot descriptions."""

LINK = '<link name="{}"/>'
BOX_LINK = """<link name="{name}"><collision><origin xyz="{centre}"/>
<geometry><box size="{size}"/></geometry></collision></link>"""


def urdf(*parts: str, name: str = "tester") -> str:
    return f'<robot name="{name}">{"".join(parts)}</robot>'


def joint(name: str, parent: str, child: str, kind: str = "revolute", inside: str = "") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<axis xyz="0 0 1"/>{inside}</joint>'
    )


def chain(*joints: str) -> str:
    """A description whose revolute joints have these names, one behind the other."""
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    links = [LINK.format(f"link{i}") for i in range(len(joints) + 1)]
    parts = [joint(n, f"link{i}", f"link{i + 1}", inside=limit) for i, n in enumerate(joints)]
    return urdf(*links, *parts)


def box_link(name: str, size: tuple[float, ...], centre: tuple[float, ...] = (0, 0, 0)) -> str:
    """A link that is a box, metres."""
    return BOX_LINK.format(
        name=name, centre=" ".join(map(str, centre)), size=" ".join(map(str, size))
    )
