"""Triangular lattices of disks of diameter 1 in a periodic cell: CSV scenes with all of their contacts."""

import math

DIAGONAL = (0.5, math.sqrt(3) / 2)


def contacts(columns, rows):
    """(a, b, image of b, direction): each disk a with its neighbours in the directions 0°, 60° and 120°."""
    found = []
    for j in range(rows):
        for i in range(columns):
            for direction, (di, dj) in enumerate([(1, 0), (0, 1), (-1, 1)]):
                x, y = i + di, j + dj
                found.append((j * columns + i, y % rows * columns + x % columns, (x // columns, y // rows), direction))
    return found


def scene(columns, rows, stress, mu=0.0, force_unit=1):
    """`stress`: lines of the table [stress], or None for no table at all."""
    disks = [f"{j * columns + i},{i + j * DIAGONAL[0]!r},{j * DIAGONAL[1]!r},0.5,1" for j in range(rows)
             for i in range(columns)]
    rows_of_contacts = [f"{a},{b},{image[0]},{image[1]}" for a, b, image, _ in contacts(columns, rows)]
    text = (f"gravity = [0, 0]\nforce_unit = {force_unit}\nmu = {mu}\n"
            f"[cell]\na = [{columns}, 0]\nb = [{rows * DIAGONAL[0]!r}, {rows * DIAGONAL[1]!r}]\n")
    if stress is not None:
        text += f"[stress]\n{stress}\n"
    return {"disks.csv": "id,x,y,radius,mass\n" + "\n".join(disks) + "\n",
            "contacts.csv": "a,b,image_x,image_y\n" + "\n".join(rows_of_contacts) + "\n",
            "scene.toml": text}
