"""Declares the members of our namespace on the page of their header, but not the namespace, which each page would declare again."""

from breathe.renderer.sphinxrenderer import SphinxRenderer, WithContext
from sphinx.domains.cpp import DefinitionParser


def namespace_symbol(env, name):
    parsed = DefinitionParser(name, location=None, config=env.config).parse_namespace_object()
    return env.domaindata["cpp"]["root_symbol"].add_name(parsed.nestedName)


def members_of_namespace(self, node):
    compound = self.compound_parser.parse(node.refid)
    compound.compounddef.briefdescription = compound.compounddef.detaileddescription = None  # those of the namespace
    parent = self.context.create_child_context(compound)
    env = self.app.env
    symbol = namespace_symbol(env, compound.compounddef.compoundname)
    before = env.temp_data.get("cpp:parent_symbol"), env.ref_context.get("cpp:parent_key")
    env.temp_data["cpp:parent_symbol"], env.ref_context["cpp:parent_key"] = symbol, symbol.get_lookup_key()
    self.nesting_level += 1  # names of classes are then those within the namespace
    with WithContext(self, parent.create_child_context(compound.compounddef)):
        found = self.render(compound, parent)
    self.nesting_level -= 1
    env.temp_data["cpp:parent_symbol"], env.ref_context["cpp:parent_key"] = before
    return found


def setup(app):
    SphinxRenderer.visit_namespace = members_of_namespace
    return {"parallel_read_safe": True, "parallel_write_safe": True}
