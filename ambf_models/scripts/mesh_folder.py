"""One folder of meshes below ambf_models/meshes: high_res for what is drawn, low_res for what collides."""

from mesh_io import write_obj, write_palette


class MeshFolder:
    def __init__(self, models, name):
        """`models`: the ambf_models folder (or the place it is regenerated into)."""
        self.path = models / "meshes" / name
        self.name = name
        self._colors = {}

    def add(self, file_name, mesh, resolution="high_res", texcoords=None):
        """Writes the mesh and returns its file name, as an ADF body wants it."""
        folder = self.path / resolution
        folder.mkdir(parents=True, exist_ok=True)
        self._colors.setdefault(resolution, set()).update(write_obj(folder / file_name, mesh, texcoords))
        return file_name

    def close(self, texture=None):
        """Writes the palette beside the meshes; `texture`: (colour, picture) for that colour's diffuse map."""
        for resolution, colors in self._colors.items():
            write_palette(self.path / resolution / "palette.mtl", colors, texture)

    def seen_from(self, levels):
        """The folder as named in an ADF file that lies `levels` folders below ambf_models."""
        return "../" * levels + f"meshes/{self.name}"
