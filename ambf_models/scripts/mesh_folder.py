"""One folder of meshes below ambf_models/meshes: high_res for what is drawn, low_res for what collides."""

from mesh_io import FINISHES, write_obj, write_palette, write_png


class MeshFolder:
    def __init__(self, models, name):
        """`models`: the ambf_models folder (or the place it is regenerated into)."""
        self.path = models / "meshes" / name
        self.name = name
        self._colors = {}
        self._finishes = dict(FINISHES)

    def print(self, color, canvas):
        """A colour of this folder alone: a picture that meshes lay on by Mesh.printed."""
        folder = self.path / "high_res"
        folder.mkdir(parents=True, exist_ok=True)
        write_png(folder / f"{color}.png", canvas.pixels())
        self._finishes[color] = (f"{color}.png", None, None)

    def add(self, file_name, mesh, resolution="high_res"):
        """Writes the mesh and returns its file name, as an ADF body wants it."""
        folder = self.path / resolution
        folder.mkdir(parents=True, exist_ok=True)
        self._colors.setdefault(resolution, set()).update(write_obj(folder / file_name, mesh, self._finishes))
        return file_name

    def close(self):
        """Writes the palette beside the meshes."""
        for resolution, colors in self._colors.items():
            write_palette(self.path / resolution / "palette.mtl", colors, self._finishes)

    def seen_from(self, levels):
        """The folder as named in an ADF file that lies `levels` folders below ambf_models."""
        return "../" * levels + f"meshes/{self.name}"
