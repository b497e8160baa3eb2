"""Breathe's page of a header declares the members of our namespace, but not the namespace: every page would declare it again."""

from breathe.renderer.sphinxrenderer import SphinxRenderer, WithContext


def members_of_namespace(self, node):
    compound = self.compound_parser.parse(node.refid)
    parent = self.context.create_child_context(compound)
    with WithContext(self, parent.create_child_context(compound.compounddef)):
        return self.render(compound, parent)


def setup(app):
    SphinxRenderer.visit_namespace = members_of_namespace
    return {"parallel_read_safe": True, "parallel_write_safe": True}
