#include "framework/record/checksum/certify.h"

#include "framework/plugin/plugin_loader.h"

namespace presa {

const CertifyPlugin& certifyPlugin() {
  static const auto* const loaded = reinterpret_cast<const CertifyPlugin*>(pluginSymbol("checksum", kCertifySymbol));
  return *loaded;
}

}  // namespace presa
