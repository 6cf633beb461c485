"""A scene small enough to simulate in a moment: a strap between a fixed and a moving block, as OBJ files."""


def write_box(path, low, high, cells):
    """A closed box as OBJ, cells[k] squares along axis k, triangles counter-clockwise seen from outside."""
    numbers, points, triangles = {}, [], []

    def vertex(place):
        if place not in numbers:
            numbers[place] = len(points) + 1
            points.append([low[k] + (high[k] - low[k]) * place[k] / cells[k] for k in range(3)])
        return numbers[place]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, cells[axis]):
            for i in range(cells[u]):
                for j in range(cells[v]):
                    corners = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        place = [0, 0, 0]
                        place[axis], place[u], place[v] = side, i + di, j + dj
                        corners.append(vertex(tuple(place)))
                    if side == 0:
                        corners.reverse()
                    triangles += [corners[:3], [corners[0], corners[2], corners[3]]]
    lines = ["v {!r} {!r} {!r}".format(*p) for p in points] + ["f {} {} {}".format(*t) for t in triangles]
    path.write_text("\n".join(lines) + "\n")
    return len(points), len(triangles)


def write_scene(folder):
    """Writes strap.obj, fixed.obj and turning.obj; returns the SOURCE options and (vertices, triangles) of the strap."""
    folder.mkdir(parents=True, exist_ok=True)
    counts = write_box(folder / "strap.obj", (-10, -5, -40), (10, 5, 40), (4, 2, 16))
    write_box(folder / "fixed.obj", (-15, -10, 40.2), (15, 10, 60), (2, 2, 2))
    write_box(folder / "turning.obj", (-15, -10, -60), (15, 10, -40.2), (2, 2, 2))
    source = ["--muscle", folder / "strap.obj", "--bone", folder / "fixed.obj",
              "--moving-bone", folder / "turning.obj", "--hinge", "0,0,-40;1,0,0", "--angle-deg", "20",
              "--phases", "6,4,2", "--units", "mm"]
    return source, counts
